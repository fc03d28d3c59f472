"""The suites of this folder: how they are found, and how one is checked, timed and judged."""

from __future__ import annotations

import re
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

from claims import judged
from equal_work import DifferentWork
from goals import GOALS
from machine import load
from timing import OURS, Timing, by_turns

FOLDER = Path(__file__).parent
_MEASURES = re.compile(r"^def measure\(", re.MULTILINE)


def names() -> list[str]:
    """Every module of this folder that has a function ``measure``."""
    return sorted(p.stem for p in FOLDER.glob("*.py") if _MEASURES.search(p.read_text("utf-8")))


def run(name: str, rounds: int, budget: float, threads: bool = False) -> dict[str, object]:
    """Check, time and judge a suite.

    Returns
    -------
    dict
        ``rows``, ``claims``, ``different`` (rows that do other work, and were not timed) and
        ``load`` before and after.
    """
    before = load()
    rows = [r for r in import_module(name).measure() if threads or r.threads == 1]
    checks, different, timings = {}, [], []
    for task in dict.fromkeys(row.task for row in rows):
        same = []
        for row in (row for row in rows if row.task == task):
            try:
                checks[row.task, row.implementation] = row.check() if row.check else ""
                same.append(row)
            except DifferentWork as error:
                different.append(
                    {"suite": name, "task": task, "implementation": row.implementation,
                     "reason": str(error)}
                )  # fmt: skip
        timings += by_turns(same, rounds, budget)
    return {
        "rows": [{"suite": name, **entry(t, timings, checks)} for t in timings],
        "claims": [
            {"suite": name, **judged(claim, timings, _of_task(checks, claim.task))}
            for claim in GOALS.get(name, ())
        ],
        "different": different,
        "load": [before, load()],
    }


def _of_task(checks: dict[tuple[str, str], str], task: str) -> dict[str, str]:
    return {name: said for (of, name), said in checks.items() if of == task}


def entry(
    timing: Timing, timings: Sequence[Timing], checks: dict[tuple[str, str], str]
) -> dict[str, object]:
    """A timing as JSON; ``ratio`` is its median over that of ours in the same task."""
    row = timing.row
    ours = next(
        (t for t in timings if t.row.task == row.task and t.row.implementation == OURS), None
    )
    micro = {
        "microseconds": 1e6 * timing.wall.median,
        "quartiles": [1e6 * timing.wall.low, 1e6 * timing.wall.high],
        "cpu_microseconds": 1e6 * timing.cpu.median,
        "cpu_quartiles": [1e6 * timing.cpu.low, 1e6 * timing.cpu.high],
    }
    return {
        "task": row.task,
        "implementation": row.implementation,
        "threads": row.threads,
        "items": row.items,
        "rounds": timing.rounds,
        **micro,
        "first_call_seconds": timing.first,
        "ratio": ours and timing.wall.median / ours.wall.median,
        "cpu_ratio": ours and timing.cpu.median / ours.cpu.median,
        "same_work": checks.get((row.task, row.implementation)) or None,
    }
