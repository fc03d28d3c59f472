"""Sphinx extension: let Python look for garbage rarely.

The book's trees of pages are millions of objects that live until the end. By default Python goes
through them after every 700 new ones, which costs almost half of a build's time.
"""

from __future__ import annotations

import gc
from typing import Any

from dualarm_repro.cli import COLLECT_AFTER as THRESHOLDS


def setup(app: Any) -> dict[str, Any]:
    """Set the thresholds of the collector, for this process."""
    gc.set_threshold(*THRESHOLDS)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
