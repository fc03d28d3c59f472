"""The viewer of the 3-D scenes: the script of the meshcat package, which holds three.js.

The package is only found, never imported: it would bring a web server and IPython with it.
"""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

#: Where a built book keeps the one viewer script, below its ``_static`` folder.
VIEWER = "meshcat/main.min.js"


def viewer_script() -> Path:
    """The viewer's JavaScript inside the installed meshcat package.

    Raises
    ------
    ModuleNotFoundError
        The package is not installed.
    """
    spec = find_spec("meshcat")
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError("No module named 'meshcat'", name="meshcat")
    return Path(spec.origin).parent / "viewer" / "dist" / "main.min.js"
