"""Configurations that bring the flange to a point, with a rule for the direction of the tool."""

from __future__ import annotations

from typing import Literal

import numpy as np

from .arm import Arm
from .poses import homogeneous

ToolRule = Literal["radial_horizontal", "tool_down", "nearest_branch"]
_ELBOW = 2  # row of frame 3 among the joint origins
_DOWN = np.array([0.0, 0.0, -1.0])


def tool_posture(arm: Arm, point: np.ndarray, rule: ToolRule) -> np.ndarray | None:
    """Configuration (6,) [rad] that brings the flange to ``point``, or None out of reach.

    The pose is completed by the direction of the tool: level and away from axis 1
    (``radial_horizontal``, ``nearest_branch``) or down (``tool_down``). Turning the tool about its
    own axis changes neither point nor direction, so that theta_6 = 0 can be had. Of the branches
    that one is taken whose elbow is highest, with the shoulder turned to the point and
    |theta_4| <= pi/2, or the one nearest to the zero configuration (``nearest_branch``). Joint
    limits are left aside.

    Parameters
    ----------
    point : (3,)
        In the frame of the base [m].

    Raises
    ------
    UnsupportedArmError
        The arm has no closed form.
    """
    radial = np.array([point[0], point[1], 0.0])
    axis = _DOWN if rule == "tool_down" else radial / np.linalg.norm(radial)
    pose = homogeneous(_frame_along(axis), point)
    found = arm.ik_branches(pose[np.newaxis], reference=np.zeros(arm.nq), within_limits=False)[0]
    found = found[~np.isnan(found).any(axis=1)]
    if rule != "nearest_branch":
        found = found[(np.abs(found[:, 3]) <= 0.5 * np.pi + 1e-9) & _forward(found, point)]
    if not len(found):
        return None
    found[:, 5] = 0.0
    if rule == "nearest_branch":
        return found[np.linalg.norm(found, axis=1).argmin()]
    height = arm.joint_positions(found)[:, _ELBOW, 2]
    highest = found[height > height.max() - 1e-9]
    return highest[np.linalg.norm(highest, axis=1).argmin()]


def _forward(q: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Whether axis 1 turns the arm toward the point and not away from it (N,)."""
    return np.cos(q[:, 0]) * point[0] + np.sin(q[:, 0]) * point[1] > 0.0


def _frame_along(axis: np.ndarray) -> np.ndarray:
    """A rotation whose third column is ``axis``."""
    across = np.cross(axis, [1.0, 0.0, 0.0] if abs(axis[2]) > 0.5 else [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across)
    return np.column_stack([across, np.cross(axis, across), axis])
