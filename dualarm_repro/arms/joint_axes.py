"""Joint frames and axes of an arm as Pinocchio places them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pinocchio as pin

from .arm import Arm


def joint_frames(arm: Arm, q: np.ndarray) -> np.ndarray:
    """Poses of joints 1 ... n in the base frame at a configuration (n,), (n, 4, 4)."""
    data = arm.model.createData()
    pin.forwardKinematics(arm.model, data, q)
    return np.array([data.oMi[k].homogeneous for k in range(1, arm.nq + 1)])


def joint_placements(arm: Arm, k: int, angles: np.ndarray) -> np.ndarray:
    """Poses of joint k = 1 ... n in the frame of the joint before it, at angles (N,), (N, 4, 4)."""
    data, found = arm.model.createData(), []
    for angle in angles:
        q = np.zeros(arm.nq)
        q[k - 1] = angle
        pin.forwardKinematics(arm.model, data, q)
        found.append(data.liMi[k].homogeneous)
    return np.array(found)


def axis_spread(arm: Arm, joints: Sequence[int], centre: int, q: np.ndarray) -> float:
    """Largest distance of the axes of joints from the origin of joint ``centre`` [m].

    Zero where they meet there, as those of a spherical wrist do.

    Parameters
    ----------
    joints
        Numbers of the joints, from 1.
    q : (N, n)
        Configurations [rad].
    """
    data, largest = arm.model.createData(), 0.0
    for row in q:
        pin.forwardKinematics(arm.model, data, row)
        point = data.oMi[centre].translation
        for joint in joints:
            placement = data.oMi[joint]
            offset = np.cross(point - placement.translation, placement.rotation[:, 2])
            largest = max(largest, float(np.linalg.norm(offset)))
    return largest


def common_origins(frames: np.ndarray) -> list[tuple[int, ...]]:
    """Numbers of the frames (N, 4, 4) that share an origin, group by group, to 1e-9 m."""
    groups: dict[tuple[float, ...], list[int]] = {}
    for number, frame in enumerate(frames):
        groups.setdefault(tuple(frame[:3, 3].round(9) + 0.0), []).append(number)
    return [tuple(group) for group in groups.values() if len(group) > 1]
