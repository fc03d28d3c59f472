"""Side-by-side timings on one thread: ``python benchmarks/run.py [--json] [SUITE ...]``.

A suite is a module of this folder with a function ``measure()`` that yields rows. Only ratios
within one run mean something: machines differ, and so does their load.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from rich.console import Console
from rich.table import Table
from timing import OURS, Row

NOT_SUITES = {"run", "timing"}
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
LIBRARIES = (
    "numpy",
    "numba",
    "pin",
    "coal",
    "roboticstoolbox-python",
    "eaik",
    "pin-pink",
    "ompl",
)


def main() -> None:
    """Run the suites and print a table, or JSON."""
    suites = sorted(p.stem for p in Path(__file__).parent.glob("*.py") if p.stem not in NOT_SUITES)
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("suites", nargs="*", metavar="SUITE", help=f"default: {' '.join(suites)}")
    parser.add_argument("--json", action="store_true", help="print JSON instead of a table")
    options = parser.parse_args()
    if unknown := set(options.suites) - set(suites):
        parser.error(f"suite {unknown.pop()!r}: expected one of {', '.join(suites)}")
    os.environ.update(dict.fromkeys(THREADS, "1"))  # before a suite imports numpy
    rows = [row for name in options.suites or suites for row in import_module(name).measure()]
    tasks = list(dict.fromkeys(row.task for row in rows))
    rows.sort(key=lambda row: tasks.index(row.task))
    report = {"cpu": _cpu(), "python": platform.python_version(), "libraries": _versions()}
    if options.json:
        print(json.dumps({**report, "rows": [_entry(row, rows) for row in rows]}, indent=2))
    else:
        _print(report, [_entry(row, rows) for row in rows])


def _entry(row: Row, rows: list[Row]) -> dict[str, object]:
    ours = next(r for r in rows if r.task == row.task and r.implementation == OURS)
    return {**vars(row), "ratio": row.microseconds / ours.microseconds}


def _print(report: dict[str, object], entries: list[dict[str, object]]) -> None:
    table = Table("task", "implementation", title=f"{report['cpu']}, one thread, medians")
    table.add_column("us per item", justify="right")
    table.add_column(f"times {OURS}", justify="right")
    for entry, before in zip(entries, [None, *entries], strict=False):
        if before and before["task"] != entry["task"]:
            table.add_section()
        table.add_row(
            entry["task"],
            entry["implementation"],
            f"{entry['microseconds']:.3f}",
            f"{entry['ratio']:.1f}",
        )
    console = Console(width=110)
    console.print(table)
    console.print(", ".join(f"{name} {number}" for name, number in report["libraries"].items()))


def _versions() -> dict[str, str]:
    found = {}
    for name in LIBRARIES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


def _cpu() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(
            line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")
        )
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


if __name__ == "__main__":
    main()
