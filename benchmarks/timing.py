"""Timings by turns: implementations of one task are called one after the other, round by round.

What disturbs the machine then disturbs all of them, so that ratios within one run mean something
where single times do not.
"""

from __future__ import annotations

import resource
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

OURS = "dualarm_repro"
ROUNDS = 15
FEWEST = 5  # rounds, where the budget of a task is used up before
BUDGET = 20.0  # of all rounds of a task [s]
TURN = 0.02  # a shorter call is repeated within a turn until that much has passed [s]


@dataclass(frozen=True)
class Row:
    """One implementation of a task, to be timed later.

    Attributes
    ----------
    call
        Does the work for ``items`` items.
    check
        Says in a phrase that the work is that of the others (:mod:`equal_work`), or raises
        ``DifferentWork``; without one a ratio counts for nothing.
    threads
        How many threads the call uses; more than one only with ``--threads``.
    rounds
        At most so many rounds, for calls of many seconds.
    """

    task: str
    implementation: str
    call: Callable[[], object]
    items: int
    check: Callable[[], str] | None = None
    threads: int = 1
    rounds: int = ROUNDS


@dataclass(frozen=True)
class Spread:
    """Median and quartiles."""

    median: float
    low: float
    high: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Spread:
        """Of a sample."""
        low, median, high = np.quantile(np.asarray(values), (0.25, 0.5, 0.75)).tolist()
        return cls(median, low, high)


@dataclass(frozen=True)
class Timing:
    """What a row took: wall and CPU time for one item [s], and its first call [s]."""

    row: Row
    wall: Spread
    cpu: Spread
    first: float
    rounds: int


def timed(
    task: str,
    implementation: str,
    call: Callable[[], object],
    items: int,
    *,
    check: Callable[[], str] | None = None,
    threads: int = 1,
    rounds: int = ROUNDS,
) -> Row:
    """A row that the harness times in turn with the other rows of its task."""
    return Row(task, implementation, call, items, check, threads, rounds)


def cpu_time() -> float:
    """User and system time of this process and of the children it has waited for [s]."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def by_turns(rows: Sequence[Row], rounds: int = ROUNDS, budget: float = BUDGET) -> list[Timing]:
    """Time every row ``rounds`` times, one row after the other in each round.

    Each row is called before once, which may compile, and again to find how often it fits into a
    turn. A round begins with another row each time. After ``budget`` seconds no round begins,
    once there were ``FEWEST``.
    """
    if not rows:
        return []
    first = [_once(row.call, 1)[0] for row in rows]
    often = [_calls_of_a_turn(row) for row in rows]
    walls: list[list[float]] = [[] for _ in rows]
    cpus: list[list[float]] = [[] for _ in rows]
    begun = time.perf_counter()
    for turn in range(rounds):
        if turn >= FEWEST and time.perf_counter() - begun > budget:
            break
        for k in np.roll(np.arange(len(rows)), -turn).tolist():
            if turn < rows[k].rounds:
                wall, cpu = _once(rows[k].call, often[k])
                walls[k].append(wall / rows[k].items)
                cpus[k].append(cpu / rows[k].items)
    return [
        Timing(row, Spread.of(wall), Spread.of(cpu), spent, len(wall))
        for row, wall, cpu, spent in zip(rows, walls, cpus, first, strict=True)
    ]


def _calls_of_a_turn(row: Row) -> int:
    """How many calls fill a turn; a row of few rounds is too long to be tried for that."""
    if row.rounds < FEWEST:
        return 1
    return max(1, int(np.ceil(TURN / max(_once(row.call, 1)[0], 1e-7))))


def _once(call: Callable[[], object], times: int) -> tuple[float, float]:
    """Mean wall and CPU time of a call [s]."""
    cpu, wall = cpu_time(), time.perf_counter()
    for _ in range(times):
        call()
    return (time.perf_counter() - wall) / times, (cpu_time() - cpu) / times
