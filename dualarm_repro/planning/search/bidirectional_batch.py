"""Many searches from both ends of one arm among the same obstacles, in one compiled call a thread.

The same paths as :func:`.bidirectional_compiled.plan_bidirectional_compiled`, search by search.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike

from ...errors import ConfigurationError, InputError
from ...kernel import kernel
from ...scene.bodies import PlacedArm
from ..descent.problem import checked_ends
from ..descent.termination import StopReason
from ..field.hull_obstacle import HullTrack
from ..field.obstacles import Obstacles
from .bidirectional_compiled import Memory, SearchRows, run, search_field, search_rules
from .bidirectional_settings import BidirectionalSettings
from .search_plan import SearchPlan, SearchRecord
from .search_problem import search_problem

#: Searches of one compiled call, whose rows are held at once.
_PORTION = 16


def plan_bidirectional_batch(
    placed: PlacedArm,
    starts: ArrayLike,
    goals: ArrayLike,
    obstacles: Obstacles,
    settings: BidirectionalSettings,
    hulls: tuple[HullTrack, HullTrack] | None = None,
    jobs: int = 1,
) -> list[SearchPlan]:
    """One plan for each row of ``starts`` and ``goals`` (N, nq) [rad].

    Parameters
    ----------
    jobs : int
        Threads; the plans are the same for any number. ``record.wall_time`` is the mean of all.

    Raises
    ------
    ConfigurationError, InputError
        Not as many goals as starts, no thread, and whatever
        :func:`.search_problem.search_problem` finds wrong.
    """
    began = perf_counter()
    first, last = (np.atleast_2d(placed.arm.configurations(end)) for end in (starts, goals))
    if first.shape != last.shape or not len(first):
        expected = f"at least one goal, as many as starts: {first.shape}"
        raise ConfigurationError(f"arm {placed.name}", "goals", last.shape, expected)
    if jobs < 1:
        raise InputError("plan_bidirectional_batch", "jobs", jobs, "at least one thread")
    made = search_problem(placed, first[0], last[0], obstacles, settings, hulls)
    if settings.enforce_limits:
        inside = np.array([placed.arm.within_limits(end) for end in (first, last)]).all(axis=0)
        if not inside.all():
            worst = int(inside.argmin())
            checked_ends(placed, first[worst], last[worst], within_limits=True)
    field, rules, sides = search_field(made), search_rules(made), 2 if settings.two_sided else 1

    def searched(rows: slice) -> list[partial[SearchRecord]]:
        count, most = len(first[rows]), settings.ending.search_limit + 1
        joints, points = first.shape[1], len(made.points.joint)
        noted = SearchRows(
            np.empty((count, 2, most, joints)),
            np.empty((count, 2, most, points)),
            np.empty((count, 2, most, points)),
        )
        flips, ends = np.zeros((count, 2), dtype=np.int64), np.empty((count, 2), dtype=np.int64)
        run_all(field, rules, made.hulls, first[rows], last[rows], noted, flips, ends)
        found = []
        for n, (reason, steps) in enumerate(ends.tolist()):
            paths, clearances, factors = (
                tuple(part[n, k, : steps + 1].copy() for k in range(sides)) for part in noted
            )
            turned = tuple(flips[n, :sides].tolist())
            end = list(StopReason)[reason]
            found.append(partial(SearchRecord, paths, clearances, factors, turned, end))
        return found

    portions = [slice(k, k + _PORTION) for k in range(0, len(first), _PORTION)]
    if jobs == 1 or len(portions) == 1:
        found = [one for rows in portions for one in searched(rows)]
    else:
        with ThreadPoolExecutor(jobs) as pool:
            found = [one for part in pool.map(searched, portions) for one in part]
    mean = (perf_counter() - began) / len(first)
    return [
        SearchPlan(replace(made, start=a, goal=b), record(mean))
        for a, b, record in zip(first.copy(), last.copy(), found, strict=True)
    ]


@kernel
def run_all(field, rules, hulls, starts, goals, noted, flips, ends):
    """:func:`.bidirectional_compiled.run` for every row; ``ends`` (N, 2): reason, searches."""
    joints, points = starts.shape[1], noted.clearance.shape[3]
    for n in range(len(starts)):
        rows = SearchRows(noted.path[n], noted.clearance[n], noted.factor[n])
        memory = Memory(
            np.zeros((2, joints)),
            np.zeros(2, dtype=np.bool_),
            flips[n],
            np.full((2, points), np.inf),
        )
        ends[n] = run(field, rules, hulls, starts[n], goals[n], rows, memory)
