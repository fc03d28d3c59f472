"""Run the tests that `make test` leaves out: those that are marked `long`."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def command() -> list[str]:
    """Words that run the long tests; their mark replaces the one of `pyproject.toml`."""
    return [sys.executable, "-m", "pytest", "-n", "auto", "-m", "long"]


def main() -> int:
    """What pytest answers."""
    return subprocess.run(command(), cwd=ROOT, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
