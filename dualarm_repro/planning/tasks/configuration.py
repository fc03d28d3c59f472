"""From what a file says of a start or goal to the joint vector of an arm."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, UnsupportedArmError
from ...scene import PlacedArm, facing
from ...scene.configuration_entry import PostureEntry
from .numeric_ik import PoseGoal, pose_posture
from .postures import posture, tool_direction
from .tip_goal import REACHED, tip_posture

_Clear = Callable[[np.ndarray], bool]


def joints_of(
    placed: PlacedArm, entry: PostureEntry | ArrayLike, clear: _Clear = lambda q: True
) -> tuple[np.ndarray, float]:
    """Joint vector of an entry (nq,), and by how much it misses the position [m].

    Parameters
    ----------
    clear : callable
        Whether the arm touches nothing; of several postures one that is clear is preferred.

    Raises
    ------
    ConfigurationError, InputError
        A vector of the wrong form; a position or pose out of reach, and by how much.
    """
    if not isinstance(entry, PostureEntry):
        return placed.arm.configurations(entry), 0.0
    reference = np.zeros(placed.arm.nq) if entry.reference is None else entry.reference
    near = placed.arm.configurations(reference)
    if (rotation := entry.rotation) is not None:
        free = None if entry.free is None else "xyz".index(entry.free)
        return _posed(placed, PoseGoal(np.array(entry.position), rotation, free), near, clear)
    if entry.tool is None:
        found = tip_posture(placed, entry.position, near, best_effort=entry.best_effort)
        return found.q, found.residual if found.residual > REACHED else 0.0
    try:
        q = posture(
            placed,
            entry.position,
            entry.tool,
            elbow=entry.elbow,
            last_joint=entry.last_joint,
            reference=entry.reference,
        )
        return q, 0.0
    except UnsupportedArmError:
        if entry.elbow is not None:
            raise InputError(
                f"arm {placed.name}", "elbow", entry.elbow, "none: this arm has no closed form"
            ) from None
    axis = tool_direction(placed, np.array(entry.position), entry.tool)
    turn, column = placed.arm.fk(near)[:3, :3], placed.arm.jacobian(near)[3:, -1]
    if not np.allclose(turn.T @ column, [0.0, 0.0, 1.0], atol=1e-6):
        expected = "an arm whose flange has its z along the last joint; give a pose instead"
        raise InputError(f"arm {placed.name}", "tool", entry.tool, expected)
    up = (0.0, 0.0, 1.0) if abs(axis[2]) < 0.9 else (1.0, 0.0, 0.0)
    goal = PoseGoal(np.array(entry.position), facing(axis, up), 2)
    return _posed(placed, goal, near, clear)


def _posed(
    placed: PlacedArm, goal: PoseGoal, near: np.ndarray, clear: _Clear
) -> tuple[np.ndarray, float]:
    tip_posture(placed, goal.position, near)
    found = pose_posture(placed, goal, near, clear)
    if not found.reached:
        expected = (
            f"a pose within reach of {placed.arm.name}: the nearest posture found misses it by "
            f"{found.missed:.4f} m and {found.turned:.4f} rad"
        )
        raise InputError(f"arm {placed.name}", "pose", goal.position.tolist(), expected)
    return found.q, 0.0
