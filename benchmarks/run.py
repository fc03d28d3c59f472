"""Side-by-side timings against peers: ``python benchmarks/run.py [--json] [SUITE ...]``.

A suite is a module of this folder with a function ``measure()`` that yields rows. The work of all
rows of a task is checked to be the same, then they are called by turns. Only ratios within one run
mean something: machines differ, and so does their load. Everything runs on one thread, but rows
that say otherwise, which ``--threads`` adds.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import traceback
from pathlib import Path

BLAS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def main() -> int:
    """Run suites and growth curves; 1 if a peer does other work or a claim names no row."""
    from suites import names

    known = names()
    options = _options(known)
    os.environ.update(dict.fromkeys(BLAS, "1"))  # before a suite imports numpy
    if not options.threads:
        os.environ["NUMBA_NUM_THREADS"] = "1"

    import growth
    import growth_claims
    import suites
    from machine import load, machine
    from peers import missing, versions
    from printed import print_report

    report = {
        **machine(), "libraries": versions(), "missing": missing(), "load": {},
        "rows": [], "claims": [], "different": [], "growth": [],
    }  # fmt: skip
    broken = []
    for name in options.suites or known:
        try:
            found = suites.run(name, options.rounds, options.budget, options.threads)
        except Exception:  # the other suites, which took long, are not lost
            print(f"suite {name} ended early:\n{traceback.format_exc()}", file=sys.stderr)
            broken.append(name)
            continue
        report["load"][name] = found.pop("load")
        for key, values in found.items():
            report[key] += values
    if options.growth:
        before = load()
        report["growth"] = growth.curves(
            min(options.rounds, growth.ROUNDS), growth.SHARE * options.budget
        )
        report["claims"] += growth_claims.judged(report["growth"])
        report["load"]["growth"] = [before, load()]
    if options.store and not broken:
        _store(report)
    if options.json:
        print(json.dumps(report, indent=2))
    else:
        print_report(report)
    return 1 if report["different"] or broken else 0


def _store(report: dict[str, object]) -> None:
    from dualarm_repro.ledger.files import to_json, write_text
    from dualarm_repro.view.benchmark_run import stored_path

    write_text(stored_path(), to_json(report))


def _options(known: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("suites", nargs="*", metavar="SUITE", help=f"default: {' '.join(known)}")
    parser.add_argument("--json", action="store_true", help="print JSON instead of tables")
    parser.add_argument("--growth", action="store_true", help="measure the growth curves too")
    parser.add_argument("--threads", action="store_true", help="time rows of several threads too")
    parser.add_argument("--store", action="store_true", help="write data/results/benchmarks.json")
    parser.add_argument("--rounds", type=int, default=15, help="at most (default 15)")
    parser.add_argument("--budget", type=float, default=20.0, help="seconds a task (default 20)")
    options = parser.parse_args()
    if unknown := set(options.suites) - set(known):
        parser.error(f"suite {unknown.pop()!r}: expected one of {', '.join(known)}")
    if options.rounds < 1:
        parser.error(f"--rounds {options.rounds}: expected at least 1")
    if options.store and options.suites:
        parser.error("--store keeps a run of every suite: name none")
    return options


if __name__ == "__main__":
    # Allow `python benchmarks/run.py` from a clone without installation of the package.
    sys.path.append(str(Path(__file__).resolve().parents[1]))
    sys.exit(main())
