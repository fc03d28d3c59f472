"""Whether a motion, whoever planned it, begins where an arm is and ends where a task wants it."""

from __future__ import annotations

import numpy as np

from ...scene import PlacedArm
from ..field.control_points import end_effector
from ..tasks.numeric_ik import PoseGoal, pose_errors
from ..tasks.task_file import ReadTask

#: Tolerances: joints and orientation [rad], position [m].
ANGLE, POSITION = 1e-2, 1e-3
#: A path whose first row is this near to the start begins there [rad, m].
BEGUN = 1e-3


def away_from_start(placed: PlacedArm, start: np.ndarray, q: np.ndarray) -> float:
    """Largest distance of a joint of q (nq,) from where the arm starts [rad, m]; whole turns of a
    continuous joint do not count."""
    return float(np.abs(placed.arm.difference(start, q)).max())


def arrives(placed: PlacedArm, task: ReadTask, q: np.ndarray) -> bool:
    """Whether q (nq,) meets the goal: its joints, or the position or pose that is asked for."""
    if np.abs(placed.arm.difference(task.goal, q)).max() <= ANGLE:
        return True
    if task.posture is None or task.posture.tool is not None:
        return False
    position, rotation = np.array(task.posture.position), task.posture.rotation
    if rotation is None:
        return bool(np.linalg.norm(end_effector(placed, q) - position) <= POSITION)
    free = None if task.posture.free is None else "xyz".index(task.posture.free)
    missed, turned = pose_errors(placed, PoseGoal(position, rotation, free), q)
    return missed <= POSITION and turned <= ANGLE
