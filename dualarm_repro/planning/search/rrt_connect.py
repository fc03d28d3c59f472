"""RRT-Connect of the Open Motion Planning Library, a yardstick for planners by potential fields.

J. J. Kuffner and S. M. LaValle, RRT-Connect: an efficient approach to single-query path planning,
ICRA 2000; I. A. Sucan, M. Moll, L. E. Kavraki, The Open Motion Planning Library, IEEE RAM 19(4),
2012.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ...errors import UnsupportedArmError
from ...scene import Scene, distances
from ..checks.contact_check import SAMPLING


class _State(Protocol):
    """A configuration of OMPL."""

    def __getitem__(self, joint: int) -> float: ...


@dataclass(frozen=True, eq=False)
class SampledPlan:
    """Path (N, nq) [rad], or None where the time was over, and the states that were checked."""

    path: np.ndarray | None
    checks: int

    @property
    def reached(self) -> bool:
        """Whether a path was found."""
        return self.path is not None


def plan_rrt_connect(
    scene: Scene, start: ArrayLike, goal: ArrayLike, seed: int, max_checks: int = 20_000
) -> SampledPlan:
    """Path of all controlled arms of a scene without contact, from ``start`` to ``goal`` [rad].

    Motions are checked every 0.02 rad. The search ends after ``max_checks`` states, not after a
    time, so that the same seed gives the same outcome on every machine.

    Raises
    ------
    UnsupportedArmError
        OMPL is not installed.
    ConfigurationError
        Start or goal of the wrong shape, with NaN or infinity.
    """
    try:
        from ompl import base, geometric, util
    except ImportError:
        raise UnsupportedArmError("RRT-Connect needs the package ompl (extra `bench`)") from None
    util.setLogLevel(util.LOG_NONE)
    util.RNG.setSeed(int(seed) + 1)
    space, bounds = base.RealVectorStateSpace(scene.nq), base.RealVectorBounds(scene.nq)
    for j, (lower, upper) in enumerate(zip(*scene.limits, strict=True)):
        bounds.setLow(j, float(lower))
        bounds.setHigh(j, float(upper))
    space.setBounds(bounds)
    checks = 0

    def vector(state: _State) -> np.ndarray:
        return np.array([state[j] for j in range(scene.nq)])

    def is_free(state: _State) -> bool:
        nonlocal checks
        checks += 1
        return bool(distances(scene, vector(state)).min() > 0.0)

    setup = geometric.SimpleSetup(space)
    setup.setStateValidityChecker(is_free)
    information = setup.getSpaceInformation()
    information.setStateValidityCheckingResolution(SAMPLING / space.getMaximumExtent())
    ends = []
    for q in (start, goal):
        state = space.allocState()
        for j, angle in enumerate(scene.configurations(q)):
            state[j] = float(angle)
        ends.append(state)
    setup.setStartAndGoalStates(*ends)
    setup.setPlanner(geometric.RRTConnect(information))
    condition = base.PlannerTerminationCondition(lambda: checks > max_checks)
    solved = setup.solve(condition)
    if not solved or not setup.haveExactSolutionPath():
        return SampledPlan(None, checks)
    return SampledPlan(np.array([vector(s) for s in setup.getSolutionPath().getStates()]), checks)
