"""A path problem as the Open Motion Planning Library takes it.

I. A. Sucan, M. Moll, L. E. Kavraki, The Open Motion Planning Library, IEEE RAM 19(4), 2012. One
joint vector of all arms is one state; a state is valid if every watched pair keeps the margin; a
motion is checked at states no further apart than the resolution.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..errors import InputError, UnsupportedArmError
from ..planning.planner import Ending, FoundPath, PathProblem

#: Extra that brings the package.
EXTRA = "planners"
#: Share of the evaluations that is left for making a path shorter.
_SHORTENING = 0.25
#: Extent of the joint space from which on OMPL finds no share of it that is a step.
_WIDEST = 1e9


def solved(problem: PathProblem, kind: str, shorten: bool, optimal: bool = False) -> FoundPath:
    """A path by the planner of OMPL of that name.

    The search ends after so many states, not after a time, so that the same seed gives the same
    path on every machine.

    Parameters
    ----------
    kind : str
        Name of a class of ``ompl.geometric``.
    shorten : bool
        Whether the path is simplified by OMPL with a quarter of the evaluations.
    optimal : bool
        Whether the planner goes on after its first path until all evaluations are used up.

    Raises
    ------
    UnsupportedArmError
        OMPL is not installed.
    InputError
        Something moves by itself, or start and goal are too far apart for a share of their way.
    """
    try:
        from ompl import base, geometric, util
    except ImportError:
        raise UnsupportedArmError(f"{kind} needs the package ompl (extra `{EXTRA}`)") from None
    problem.at_rest(kind)
    util.setLogLevel(util.LOG_NONE)
    util.RNG.setSeed(problem.settings.seed + 1)
    space = base.RealVectorStateSpace(problem.scene.nq)
    bounds = base.RealVectorBounds(problem.scene.nq)
    lower, upper = problem.limits
    for j in range(problem.scene.nq):
        bounds.setLow(j, float(lower[j]))
        bounds.setHigh(j, float(upper[j]))
    space.setBounds(bounds)
    setup = geometric.SimpleSetup(space)
    margin = problem.margin
    setup.setStateValidityChecker(lambda s: problem.clearance(_vector(s, len(lower))) > margin)
    information = setup.getSpaceInformation()
    extent = space.getMaximumExtent()
    if not extent < _WIDEST:
        expected = f"at most {_WIDEST:g} [rad, m] apart, limits and ends"
        raise InputError(kind, "range of the joints", extent, expected)
    # A share below 1 is demanded, also of joints whose whole range is below the resolution.
    fraction = problem.settings.resolution / max(extent, 2.0 * problem.settings.resolution)
    information.setStateValidityCheckingResolution(fraction)
    setup.setStartAndGoalStates(*(_state(space, q) for q in (problem.start, problem.goal)))
    if optimal:
        setup.setOptimizationObjective(base.PathLengthOptimizationObjective(information))
    setup.setPlanner(getattr(geometric, kind)(information))
    budget = problem.settings.evaluations
    most = (1.0 - _SHORTENING if shorten else 1.0) * budget
    done = setup.solve(base.PlannerTerminationCondition(lambda: problem.evaluations >= most))
    if not done or not setup.haveExactSolutionPath():
        return FoundPath(problem.start[np.newaxis], Ending.BUDGET)
    path = setup.getSolutionPath()
    if shorten:
        _shortened(geometric, base, information, path, lambda: problem.spent)
    rows = np.array([_vector(state, len(lower)) for state in path.getStates()])
    return FoundPath(rows, Ending.REACHED)


def _shortened(
    geometric: Any, base: Any, information: Any, path: Any, over: Callable[[], bool]
) -> None:
    simplifier = geometric.PathSimplifier(information)
    simplifier.simplify(path, base.PlannerTerminationCondition(over))


def _state(space: Any, q: np.ndarray) -> Any:
    state = space.allocState()
    for j, angle in enumerate(q):
        state[j] = float(angle)
    return state


def _vector(state: Any, count: int) -> np.ndarray:
    return np.array([state[j] for j in range(count)])
