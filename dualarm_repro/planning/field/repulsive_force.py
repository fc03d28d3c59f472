"""Repulsion of control points by the distance to obstacles, carried over to the joints.

U_i = eta_i/2 (1/rho - 1/rho_0)^2 for rho <= rho_0, else 0;
F_i = eta_i (1/rho - 1/rho_0)/rho^2 grad rho, and F(q) = sum_i J_v,i^T F_i.
O. Khatib, Int. J. Robotics Research 5(1), 1986; Spong, Hutchinson, Vidyasagar, ch. 5.
"""

from __future__ import annotations

import numpy as np

from ...kernel import kernel
from ...scene.vectors import cross, dot


def inverse_distance_potential(
    rho: np.ndarray | float, gain: np.ndarray | float, influence: float
) -> np.ndarray:
    """U_i(rho) for distances rho > 0 [m]."""
    near = np.minimum(rho, influence)
    return 0.5 * gain * (1.0 / near - 1.0 / influence) ** 2


@kernel
def inverse_distance_force(rho, gain, influence, contact):
    """|F_i|; distances below ``contact``, and so penetrations, count as ``contact``."""
    near = min(max(rho, contact), influence)
    return gain * (1.0 / near - 1.0 / influence) / (near * near)


def joint_torques(
    frames: np.ndarray, joint: np.ndarray, points: np.ndarray, forces: np.ndarray
) -> np.ndarray:
    """sum_i J_v,i^T F_i (nq,).

    Parameters
    ----------
    frames : (nq + 1, 3, 4)
        Frames of base and joints, z the axis of each joint.
    joint : (K,)
        Joint that carries each control point.
    points, forces : (K, 3)
        In the world.
    """
    axes, origins = frames[1:, :, 2], frames[1:, :, 3]
    velocity = np.cross(axes, points[:, np.newaxis] - origins)
    carried = np.arange(1, len(frames)) <= joint[:, np.newaxis]
    return np.einsum("kr,kjr,kj->j", forces, velocity, carried)


@kernel
def add_torque(frames, joint, point, force, out):
    """J_v^T F of one control point added to ``out`` (nq,)."""
    for j in range(joint):
        frame = frames[j + 1]
        lever = point[0] - frame[0, 3], point[1] - frame[1, 3], point[2] - frame[2, 3]
        out[j] += dot(force, cross((frame[0, 2], frame[1, 2], frame[2, 2]), lever))
