"""Attack the project in every way it has, each in its long form, and write the figures.

A part that finds something does not keep the others from running; 1 if any did.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

TOOLS = Path(__file__).resolve().parent
RESULTS = TOOLS.parent / "data" / "results"
#: Hostile inputs of the long form, beside those that the tests try.
CASES = 100_000
PARTS: dict[str, tuple[str, ...]] = {
    "run_long_tests": (),
    "fuzz": ("--cases", str(CASES), "--out", str(RESULTS / "fuzz.json")),
    "faults": (),
    "determinism": (),
    "trust_ledger": (),
    "install_matrix": ("--resume",),
    "branch_coverage": (),
    "trust_figures": (),
}


def command(part: str) -> list[str]:
    """Words that run a part."""
    return [sys.executable, str(TOOLS / f"{part}.py"), *PARTS[part]]


def main() -> int:
    """Run every part and name those that found something."""
    failed = []
    for part in PARTS:
        print(f"== {part}", flush=True)
        if subprocess.run(command(part), cwd=TOOLS.parent, check=False).returncode:
            failed.append(part)
    print(f"found something: {', '.join(failed)}" if failed else "nothing found")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
