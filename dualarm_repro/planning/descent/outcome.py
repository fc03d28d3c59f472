"""From the rows a planner loop leaves behind to a plan with its reason and certificate."""

from __future__ import annotations

import numpy as np

from ...arms import Arm
from ..plan import Plan, Record
from ..settings import Switching
from .certificate import certify
from .follow_reason import FollowReason
from .problem import PlanningProblem
from .termination import StopReason, within

_IN_A_TRAP = (Switching.ON_WHEN_STUCK, Switching.REPLACES_GOAL)


def finished(made: PlanningProblem, record: Record) -> Plan:
    """The plan of a record, with what is known about its end."""
    last, steps = record.path[-1], len(record.path) - 1
    parts = vars(record) | {"reason": refined(made, record.reason, last, steps)}
    return Plan(
        placed=made.placed,
        goal=made.goal,
        point_names=made.points.names,
        obstacle_names=made.obstacles.names,
        certificate=None if record.reason is StopReason.REACHED else certify(made, last, steps),
        rescued=rescued(made, record.reason, record.activations),
        outside_limits=leaves_limits(made.placed.arm, made.start, made.goal, record.path),
        **parts,
    )


def leaves_limits(
    arm: Arm, start: np.ndarray, goal: np.ndarray, path: np.ndarray
) -> tuple[str, ...]:
    """Which of ``start``, ``goal`` and ``path`` leave the joint limits."""
    looked_at = {"start": start, "goal": goal, "path": path}
    return tuple(name for name, q in looked_at.items() if not np.all(arm.within_limits(q, 1e-9)))


def refined(
    made: PlanningProblem, reason: StopReason | FollowReason, q: np.ndarray, step: int
) -> StopReason | FollowReason:
    """Whether a trapped arm rests close to a goal at which an obstacle repels it."""
    if reason is not StopReason.TRAPPED:
        return reason
    factor = made.settings.termination.near_goal
    close = within(*made.errors(q), *(factor * tolerance for tolerance in made.tolerances))
    return StopReason.NEAR_OBSTACLE if close and made.repels_at_goal(step) else reason


def rescued(made: PlanningProblem, reason: StopReason | FollowReason, activations: int) -> bool:
    """Whether the goal is reached after a virtual point was switched on in a trap."""
    point = made.settings.virtual_point
    tried = point is not None and point.switching in _IN_A_TRAP and activations > 0
    return tried and reason is StopReason.REACHED
