"""Try whether the ledger notices what is wrong, in four directions, and count what it notices.

What is obtained, printed and assumed is changed item by item; the method by a seeded sample of
mutants of its sources. Ends with 1 if anything goes unnoticed.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import mutation_run

from dualarm_repro.ledger.files import to_json, write_text
from dualarm_repro.ledger.trust import DIRECTIONS, Tally, tally
from dualarm_repro.ledger.trust.report import digest_of, read_report, report, report_path
from dualarm_repro.papers import load

#: Mutants of the quick form, which computes no stored cell again.
QUICK = 4


def main(arguments: list[str] | None = None) -> int:
    """Run all four directions, print the counts and write the outcome."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} mutants, nothing written")
    parser.add_argument("--out", type=Path, default=None, help="file to write")
    parser.add_argument(
        "--survivors",
        action="store_true",
        help="of the mutants only those that the stored outcome calls unnoticed, if the methods "
        "are the same",
    )
    asked = parser.parse_args(arguments)
    stored = read_report() if asked.survivors else None
    if asked.survivors and (stored is None or stored["code"] != digest_of(mutation_run.ROOMS)):
        print("no stored outcome of these methods", file=sys.stderr)
        return 2
    noticed = mutation_run.killers(stored["mutants"] if stored else ())
    registry = load()
    tallies = {
        name: sum((tally(registry, item, name) for item in registry.checkers), Tally())
        for name in DIRECTIONS
    }
    for name, one in tallies.items():
        for line in one.violations:
            print(f"{name}: unnoticed: {line}", flush=True)
    rows = []
    with TemporaryDirectory() as folder:
        limit = QUICK if asked.quick else None
        for row in mutation_run.run(Path(folder), limit=limit, noticed=noticed):
            fate = row["killed_by"] or row["equivalent"] or "SURVIVED"
            where = f"{row['file']}:{row['line']} {row['old']} -> {row['new']}"
            print(f"method: {where}: {fate}", flush=True)
            rows.append(row)
    found = report(tallies, mutation_run.ROOMS, mutation_run.SEED, rows)
    if asked.out or not asked.quick:
        write_text(asked.out or report_path(), to_json(found))
    for name, counts in found["counts"].items():
        print(f"{name:9}", ", ".join(f"{key} {number}" for key, number in counts.items()))
    return int(any(counts["survived"] for counts in found["counts"].values()))


if __name__ == "__main__":
    sys.exit(main())
