"""Whether somebody watches what a process says of its progress."""

from __future__ import annotations

import os
import sys


def watched() -> bool:
    """Whether standard error is a terminal, and not that of a CI service."""
    return sys.stderr.isatty() and not os.environ.get("CI")
