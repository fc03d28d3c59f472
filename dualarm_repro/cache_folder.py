"""Where the package keeps what it can compute again: records, compiled code, the import graph."""

from __future__ import annotations

import os
from pathlib import Path

#: Environment variable: folder of the cache, or ``off``.
CACHE_VARIABLE = "DUALARM_CACHE"


def cache_folder() -> Path | None:
    """Folder of the cache (``DUALARM_CACHE``, else the user's); None if switched off."""
    chosen = os.environ.get(CACHE_VARIABLE)
    if chosen == "off":
        return None
    if chosen:
        return Path(chosen)
    from platformdirs import user_cache_path

    return user_cache_path("dualarm_repro")
