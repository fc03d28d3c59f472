"""The viewer of the 3-D scenes: the script of the meshcat package, which holds three.js."""

from __future__ import annotations

from pathlib import Path

import meshcat

#: Where a built book keeps the one viewer script, below its ``_static`` folder.
VIEWER = "meshcat/main.min.js"


def viewer_script() -> Path:
    """The viewer's JavaScript inside the installed meshcat package."""
    return Path(meshcat.__file__).parent / "viewer" / "dist" / "main.min.js"
