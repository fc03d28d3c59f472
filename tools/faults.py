"""Bring faults about - kills, full disks, bad caches, odd surroundings - and count what survives.

A command survives if it ends as it should - with its results, or in one line with nothing
half-written - and gives the same results when it is run again. ``data/results/faults.json`` holds
the counts of each kind and what did not survive. Ends with 1 if anything did not.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from fault_injection import caches, disks, struck, surroundings
from fault_injection.jobs import FORWARD, LONG, PLAN, ROBUSTNESS, RUN, SHOW, STUDY, VERIFY
from fault_injection.laboratory import Laboratory, Trial

from dualarm_repro.ledger.files import to_json, write_text

STORED = Path(__file__).resolve().parents[1] / "data" / "results" / "faults.json"
SEED = 17
#: Random moments, sizes and damages of each kind and command; six commands are killed.
REPEATS = 10
KINDS: dict[str, Callable[[Laboratory], Iterator[Trial]]] = {
    "killed": lambda lab: struck.killed(lab, LONG),
    "interrupted": lambda lab: struck.interrupted(lab, (RUN, ROBUSTNESS, PLAN, VERIFY)),
    "two at once": lambda lab: struck.twice(lab, (RUN, STUDY, PLAN)),
    "full disk": lambda lab: disks.full(lab, (RUN, PLAN), (SHOW, FORWARD)),
    "read-only folder": lambda lab: disks.read_only(lab, (RUN, SHOW, FORWARD)),
    "damaged record": caches.records,
    "damaged table": caches.tables,
    "damaged machine code": caches.machine_code,
    "damaged notebook cache": caches.notebooks,
    "missing package": surroundings.missing,
    "locale": lambda lab: surroundings.locales(lab, (SHOW, RUN, PLAN)),
    "odd folder": lambda lab: surroundings.folders(lab, (RUN, PLAN)),
}


def counted(trials: Iterable[Trial]) -> dict[str, Any]:
    """Counts of each kind, and what did not survive with how often; no clocks, no folders."""
    trials = list(trials)
    tried = Counter(one.kind for one in trials)
    lost = Counter(one.kind for one in trials if one.wrong)
    reasons = Counter(f"{one.kind}: {one.name}: {one.wrong}" for one in trials if one.wrong)
    return {
        "seed": SEED,
        "counts": {k: {"tried": n, "survived": n - lost[k]} for k, n in sorted(tried.items())},
        "lost": dict(sorted(reasons.items())),
    }


def tried(lab: Laboratory, kinds: Iterable[str]) -> Iterator[Trial]:
    """Every fault of these kinds, told as soon as it has been tried."""
    for kind in kinds:
        try:
            for trial in KINDS[kind](lab):
                print(f"{trial.kind}: {trial.name}: {trial.wrong or 'survived'}", flush=True)
                yield trial
        except RuntimeError as failure:  # a command without a fault; the other kinds go on
            print(f"{kind}: {failure}", flush=True)
            yield Trial(kind, "without a fault", str(failure))


def main(arguments: list[str] | None = None) -> int:
    """Try the kinds that are asked for; only all of them together are stored."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"of {', '.join(KINDS)}")
    parser.add_argument("--repeats", type=int, default=REPEATS)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--out", type=Path, default=None, help="file to write")
    asked = parser.parse_args(arguments)
    if unknown := set(asked.kinds) - set(KINDS):
        parser.error(f"no such kind: {', '.join(sorted(unknown))}")
    with TemporaryDirectory(prefix="faults-") as folder:
        lab = Laboratory(Path(folder), np.random.default_rng(asked.seed), asked.repeats)
        found = counted(tried(lab, asked.kinds or KINDS)) | {"seed": asked.seed}
    if asked.out or not asked.kinds:
        write_text(asked.out or STORED, to_json(found))
    for kind, counts in found["counts"].items():
        print(f"{kind:24}", ", ".join(f"{key} {number}" for key, number in counts.items()))
    return int(bool(found["lost"]))


if __name__ == "__main__":
    sys.exit(main())
