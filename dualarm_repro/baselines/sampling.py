"""Sampling-based planners of today: RRT-Connect for all arms or one after the other, and BIT*."""

from __future__ import annotations

from itertools import islice, permutations

import numpy as np

from ..planning.planner import Ending, FoundPath, PathProblem
from .ompl_problem import solved

#: Orders of the arms that are tried.
_ORDERS = 6


def rrt_connect(problem: PathProblem) -> FoundPath:
    """RRT-Connect of OMPL over all joints of all arms, without simplification.

    J. J. Kuffner and S. M. LaValle, RRT-Connect: an efficient approach to single-query path
    planning, ICRA 2000.
    """
    return solved(problem, "RRTConnect", shorten=False)


def rrt_connect_simplified(problem: PathProblem) -> FoundPath:
    """RRT-Connect of OMPL over all joints of all arms, then its path simplification."""
    return solved(problem, "RRTConnect", shorten=True)


def rrt_connect_in_turn(problem: PathProblem) -> FoundPath:
    """RRT-Connect with simplification, one arm after the other while the others stand still.

    The arms that have moved stand at their goals, those that have not at their starts; up to six
    orders are tried.
    """
    names, columns = list(problem.scene.columns), problem.scene.columns
    for order in islice(permutations(names), _ORDERS):
        q = problem.start.copy()
        rows = [q]
        for name in order:
            standing = {other: q[columns[other]] for other in names if other != name}
            alone = problem.without(standing)
            alone.start = q[columns[name]]
            ends = (alone.clearance(alone.start), alone.clearance(alone.goal))
            found = None
            if min(ends) > 0.0:
                found = solved(alone, "RRTConnect", shorten=True)
            problem.evaluations += alone.evaluations
            if found is None or not found.claimed:
                break
            part = np.tile(q, (len(found.path), 1))
            part[:, columns[name]] = found.path
            rows += list(part[1:])
            q = rows[-1].copy()
        else:
            return FoundPath(np.array(rows), Ending.REACHED)
        if problem.spent:
            break
    return FoundPath(problem.start[np.newaxis], Ending.BUDGET)


def bit_star(problem: PathProblem) -> FoundPath:
    """BIT* of OMPL over all joints: batches of samples as in PRM*, towards the shortest path.

    J. D. Gammell, T. D. Barfoot, S. S. Srinivasa, Batch informed trees (BIT*): informed
    asymptotically optimal anytime motion planning, IJRR 39(5), 2020.
    """
    return solved(problem, "BITstar", shorten=False, optimal=True)
