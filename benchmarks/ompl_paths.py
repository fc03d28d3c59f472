"""RRT-Connect of OMPL with its simplification, with any check of a configuration."""

from __future__ import annotations

from time import perf_counter
from typing import Any

import numpy as np
from equal_work import DifferentWork
from pinocchio_checks import RESOLUTION, Free

SECONDS = 5.0  # of one search and again of its simplification, at most


def ompl_path(
    limits: tuple[np.ndarray, np.ndarray],
    start: np.ndarray,
    goal: np.ndarray,
    free: Free,
    seed: int,
) -> np.ndarray | None:
    """A path (N, nq) [rad], simplified until OMPL finds nothing more to do; None if there was none
    within ``SECONDS``.

    Raises
    ------
    DifferentWork
        Start or goal is not valid for the check that OMPL is given; it would wait for another one.
    """
    from ompl import base, geometric, util

    util.setLogLevel(util.LOG_NONE)
    util.RNG.setSeed(seed + 1)
    joints = range(len(start))
    space, bounds = base.RealVectorStateSpace(len(start)), base.RealVectorBounds(len(start))
    for j, (low, high) in enumerate(zip(*limits, strict=True)):
        bounds.setLow(j, float(low))
        bounds.setHigh(j, float(high))
    space.setBounds(bounds)
    setup = geometric.SimpleSetup(space)
    setup.setStateValidityChecker(lambda state: bool(free(np.array([state[j] for j in joints]))))
    information = setup.getSpaceInformation()
    information.setStateValidityCheckingResolution(RESOLUTION / space.getMaximumExtent())
    for q in (start, goal):
        if not free(q):
            raise DifferentWork("an end of the path is not free for OMPL")
    setup.setStartAndGoalStates(_state(space, start), _state(space, goal))
    setup.setPlanner(geometric.RRTConnect(information))
    setup.solve(_time_over(base))
    if not setup.haveExactSolutionPath():
        return None
    path = setup.getSolutionPath()
    geometric.PathSimplifier(information).simplify(path, _time_over(base))
    return np.array([[state[j] for j in joints] for state in path.getStates()])


def ompl_path_in_turn(
    limits: tuple[np.ndarray, np.ndarray],
    arms: list[slice],
    start: np.ndarray,
    goal: np.ndarray,
    free: Free,
    seed: int,
) -> np.ndarray | None:
    """A path (N, nq) [rad] of one arm after the other in the order given, None if one has none.

    No other order is tried: the time of a search in vain would count as that of a path.
    """
    paths, here = [start[None]], start
    for columns in arms:

        def free_alone(q: np.ndarray, here: np.ndarray = here, at: slice = columns) -> bool:
            whole = here.copy()
            whole[at] = q
            return free(whole)

        box = limits[0][columns], limits[1][columns]
        found = ompl_path(box, here[columns], goal[columns], free_alone, seed)
        if found is None:
            return None
        rows = np.tile(here, (len(found), 1))
        rows[:, columns] = found
        paths.append(rows[1:])
        here = rows[-1]
    return np.concatenate(paths)


def _state(space: Any, q: np.ndarray) -> Any:
    state = space.allocState()
    for j, angle in enumerate(q):
        state[j] = float(angle)
    return state


def _time_over(base: Any) -> Any:
    until = perf_counter() + SECONDS
    return base.PlannerTerminationCondition(lambda: perf_counter() > until)
