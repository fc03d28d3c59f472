"""RRT-Connect in compiled code, with certified edges: all arms at once, or one after the other."""

from __future__ import annotations

from itertools import islice, permutations

import numpy as np

from ..planning.planner import Ending, FoundPath, PathProblem
from ..planning.search.rrt_connect_compiled import plan_rrt_connect_compiled

#: Orders of the arms that are tried.
_ORDERS = 6


def rrt_connect_compiled(problem: PathProblem) -> FoundPath:
    """RRT-Connect in compiled code over all joints of all arms, then shortcuts; edges are proved.

    Needs no other library; J. J. Kuffner and S. M. LaValle, ICRA 2000.
    """
    problem.at_rest("rrt-connect-compiled")
    rng = np.random.default_rng(problem.settings.seed)
    path = _moved(problem, rng, problem.start, problem.goal, problem.limits)
    if path is None:
        return FoundPath(problem.start[np.newaxis], Ending.BUDGET)
    return FoundPath(path, Ending.REACHED)


def rrt_connect_compiled_in_turn(problem: PathProblem) -> FoundPath:
    """RRT-Connect in compiled code, one arm after the other while the others stand still.

    The arms that have moved stand at their goals, those that have not at their starts; up to six
    orders are tried.
    """
    problem.at_rest("rrt-connect-compiled-in-turn")
    rng = np.random.default_rng(problem.settings.seed)
    for order in islice(permutations(problem.scene.columns), _ORDERS):
        paths = [problem.start[np.newaxis]]
        for name in order:
            columns, here = problem.scene.columns[name], paths[-1][-1]
            goal, limits = here.copy(), (here.copy(), here.copy())
            goal[columns] = problem.goal[columns]
            for end, bound in zip(limits, problem.limits, strict=True):
                end[columns] = bound[columns]
            path = _moved(problem, rng, here, goal, limits)
            if path is None:
                break
            paths.append(path[1:])
        else:
            return FoundPath(np.concatenate(paths), Ending.REACHED)
        if problem.spent:
            break
    return FoundPath(problem.start[np.newaxis], Ending.BUDGET)


def _moved(
    problem: PathProblem,
    rng: np.random.Generator,
    start: np.ndarray,
    goal: np.ndarray,
    limits: tuple[np.ndarray, np.ndarray],
) -> np.ndarray | None:
    """A path, whose configurations are counted; None if there is none within the budget."""
    left = problem.settings.evaluations - problem.evaluations
    found = plan_rrt_connect_compiled(
        problem.scene, start, goal, rng, problem.margin, max(left, 0), limits
    )
    problem.evaluations += found.checks
    return found.path
