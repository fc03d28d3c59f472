"""Share of the library's branches that the tests reach, by room: ``data/results/coverage.json``."""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from dualarm_repro.ledger.files import to_json, write_text

ROOT = Path(__file__).resolve().parents[1]
STORED = ROOT / "data" / "results" / "coverage.json"
SETTINGS = ROOT / "tools" / "coverage.ini"
#: Long tests too, which an empty mark does not leave out.
SUITE = ("-n", "auto", "-m", "")


def by_room(files: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Branches of each room, from the ``files`` of coverage's own JSON report."""
    there: Counter[str] = Counter()
    reached: Counter[str] = Counter()
    for name, found in files.items():
        parts = Path(name).parts
        room = parts[parts.index("dualarm_repro") + 1].removesuffix(".py")
        there[room] += found["summary"]["num_branches"]
        reached[room] += found["summary"]["covered_branches"]
    rooms = {
        room: {"branches": there[room], "reached": reached[room]} for room in sorted(there)
    }  # fmt: skip
    return {"branches": there.total(), "reached": reached.total(), "rooms": rooms}


def main(arguments: list[str] | None = None) -> int:
    """Run the tests and store the shares; 1 if a test failed, 2 if coverage is not installed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tests", nargs="*", help="arguments of pytest; without, the whole suite")
    parser.add_argument("--out", type=Path, default=None, help="file to write")
    asked = parser.parse_args(arguments)
    if find_spec("coverage") is None:
        print("branch_coverage: the package coverage is not installed", file=sys.stderr)
        return 2
    folder = ROOT / "_build" / "coverage"
    folder.mkdir(parents=True, exist_ok=True)
    # Absolute, since tests call commands in folders of their own.
    measured = {"COVERAGE_FILE": str(folder / "data"), "COVERAGE_RCFILE": str(SETTINGS)}

    def coverage(*words: object) -> int:
        command = [sys.executable, "-m", "coverage", *map(str, words)]
        return subprocess.run(
            command, cwd=ROOT, env={**os.environ, **measured}, check=False
        ).returncode

    coverage("erase")
    tests = coverage("run", "-m", "pytest", *(asked.tests or SUITE))
    report = folder / "report.json"
    if coverage("combine", "-q") or coverage("json", "-q", "-o", report):
        print("branch_coverage: nothing was measured", file=sys.stderr)
        return 1
    found = by_room(json.loads(report.read_text(encoding="utf-8"))["files"])
    if asked.out or not asked.tests:
        write_text(asked.out or STORED, to_json(found))
    print(f"{found['reached']} of {found['branches']} branches")
    return int(tests != 0)


if __name__ == "__main__":
    sys.exit(main())
