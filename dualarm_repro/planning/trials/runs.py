"""Many runs of one planner, each from its own start: how they end, touching starts included."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError
from ...scene import PlacedArm
from ..descent.batch import Batch, plan_batch
from ..descent.compiled import plan_apf_compiled
from ..descent.problem import PlanningProblem, problem
from ..descent.termination import StopReason
from ..field.obstacles import Obstacles
from ..master_slave import Planner
from ..plan import Plan
from ..settings import APFSettings

BatchPlanner = Callable[[PlacedArm, ArrayLike, ArrayLike, Obstacles, APFSettings], Batch]
#: Reason of a run whose start touches an obstacle.
TOUCHES = "start-touches-obstacle"


class Runs(NamedTuple):
    """Ends of N runs.

    Attributes
    ----------
    reason : ndarray (N,) of StopReason or FollowReason, or TOUCHES
    steps : ndarray (N,) of int
    last : ndarray (N, nq)
        Configurations at the end [rad].
    gradient : ndarray (N,)
        |d(U_att + U_rep)/dq| there.
    used, rescued : ndarray (N,) of bool
        Whether a virtual point acted, and whether the goal was reached after it did.
    """

    reason: np.ndarray
    steps: np.ndarray
    last: np.ndarray
    gradient: np.ndarray
    used: np.ndarray
    rescued: np.ndarray

    @property
    def reached(self) -> np.ndarray:
        """Which runs arrived (N,)."""
        return self.reason == StopReason.REACHED

    @property
    def stuck(self) -> np.ndarray:
        """Which runs were seen to stand still away from the goal (N,)."""
        return np.isin(self.reason, (StopReason.TRAPPED, StopReason.NEAR_OBSTACLE))

    def replaced(self, where: np.ndarray, new: Runs) -> Runs:
        """The same runs, but for those at ``where`` (N,) of bool, which are the rows of ``new``."""
        runs = Runs(*(part.copy() for part in self))
        for part, rows in zip(runs, new, strict=True):
            part[where] = rows
        return runs


def attempt(
    placed: PlacedArm,
    start: np.ndarray,
    obstacles: Obstacles,
    settings: APFSettings,
    planner: Planner = plan_apf_compiled,
) -> Plan | None:
    """A plan to the goal of the arm, or None where its start (nq,) touches an obstacle."""
    goal = _given(placed, "goal")
    try:
        return planner(placed, start, goal, obstacles, settings)
    except InputError:
        return None


def touching(made: PlanningProblem, starts: np.ndarray) -> np.ndarray:
    """At which of the starts (N, nq) a control point touches or is inside an obstacle (N,)."""
    return made.repulsion.distances(starts).min(axis=(1, 2), initial=np.inf) <= 0.0


def run_trials(
    placed: PlacedArm,
    starts: np.ndarray,
    obstacles: Obstacles,
    settings: APFSettings,
    planner: BatchPlanner = plan_batch,
) -> Runs:
    """One run to the goal of the arm per start (N, nq); one that touches an obstacle ends there.

    Raises
    ------
    ConfigurationError, InputError
        As for a single plan from ``placed.start``, about which the starts are thought to lie.
    """
    start, goal = _given(placed, "start"), _given(placed, "goal")
    made = problem(placed, start, goal, obstacles, settings)
    count, clear = len(starts), ~touching(made, starts)
    nothing, never = np.zeros(count, dtype=int), np.zeros(count, dtype=bool)
    reason = np.full(count, TOUCHES, dtype=object)
    runs = Runs(reason, nothing, starts.copy(), np.zeros(count), never, never.copy())
    if not clear.any():
        return runs
    batch = planner(placed, starts[clear], goal, obstacles, settings)
    reasons = np.array(batch.reason, dtype=object)
    ends = (reasons, batch.steps, batch.last, batch.gradient_norm, batch.activations > 0)
    return runs.replaced(clear, Runs(*ends, batch.rescued))


def _given(placed: PlacedArm, field: str) -> np.ndarray:
    """Start or goal of a placed arm (nq,) [rad]."""
    found = getattr(placed, field)
    if found is None:
        raise InputError(f"arm {placed.name}", field, None, "a configuration")
    return found
