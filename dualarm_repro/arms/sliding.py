"""Kinematics of serial chains in which some joints slide along their axis.

T(q) = C_0 M_1(q_1) C_1 ... M_n(q_n) C_n with M_j(q) = Rz(q) for a joint that turns [rad] and
Tz(q) for one that slides [m]. Chains in which every joint turns have faster kernels of their own
(:mod:`.kernels`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..kernel import kernel


class SlidingChain(NamedTuple):
    """Constant transforms as in :class:`.kernels.Chain`, and which joints slide (n,) of bool."""

    rotation: np.ndarray
    translation: np.ndarray
    slides: np.ndarray


@kernel
def sliding_frames(chain, base, q):
    """Frames of the base and of the joints, F_0 = base, F_j = F_(j-1) C_(j-1) M_j(q_j).

    Parameters
    ----------
    base : (3, 4)
    q : (N, n) [rad, m]

    Returns
    -------
    ndarray (N, n+1, 3, 4)
        Rotation and origin; z is the axis of every joint.
    """
    count, joints = q.shape
    frames = np.empty((count, joints + 1, 3, 4))
    for n in range(count):
        frames[n, 0] = base
        for j in range(joints):
            F, G, C, t = frames[n, j], frames[n, j + 1], chain.rotation[j], chain.translation[j]
            s, c, slide = np.sin(q[n, j]), np.cos(q[n, j]), 0.0
            if chain.slides[j]:
                s, c, slide = 0.0, 1.0, q[n, j]
            for r in range(3):
                x = F[r, 0] * C[0, 0] + F[r, 1] * C[1, 0] + F[r, 2] * C[2, 0]
                y = F[r, 0] * C[0, 1] + F[r, 1] * C[1, 1] + F[r, 2] * C[2, 1]
                G[r, 0], G[r, 1] = c * x + s * y, c * y - s * x
                G[r, 2] = F[r, 0] * C[0, 2] + F[r, 1] * C[1, 2] + F[r, 2] * C[2, 2]
                G[r, 3] = F[r, 0] * t[0] + F[r, 1] * t[1] + F[r, 2] * t[2] + F[r, 3]
                G[r, 3] += slide * G[r, 2]
    return frames


def poses(chain: SlidingChain, q: np.ndarray) -> np.ndarray:
    """T(q) for rows of q (N, n) -> (N, 4, 4) [m]."""
    last = sliding_frames(chain, np.eye(3, 4), q)[:, -1]
    found = np.zeros((len(q), 4, 4))
    found[:, :3, :3] = last[:, :, :3] @ chain.rotation[-1]
    found[:, :3, 3] = last[:, :, :3] @ chain.translation[-1] + last[:, :, 3]
    found[:, 3, 3] = 1.0
    return found


def positions(chain: SlidingChain, q: np.ndarray) -> np.ndarray:
    """Position of the flange, (N, n) -> (N, 3) [m]."""
    return poses(chain, q)[:, :3, 3]


def frame_origins(chain: SlidingChain, q: np.ndarray) -> np.ndarray:
    """Origins of the joint frames and of the flange, (N, n) -> (N, n+1, 3) [m]."""
    joints = sliding_frames(chain, np.eye(3, 4), q)[:, 1:, :, 3]
    return np.concatenate([joints, positions(chain, q)[:, np.newaxis]], axis=1)


def jacobians(chain: SlidingChain, q: np.ndarray) -> np.ndarray:
    """Columns [z_j x (p - o_j); z_j], of a sliding joint [z_j; 0], (N, n) -> (N, 6, n)."""
    frames = sliding_frames(chain, np.eye(3, 4), q)[:, 1:]
    axes = frames[:, :, :, 2]
    turning = np.cross(axes, positions(chain, q)[:, np.newaxis] - frames[:, :, :, 3])
    slides = chain.slides[:, np.newaxis]
    linear, angular = np.where(slides, axes, turning), np.where(slides, 0.0, axes)
    return np.concatenate([linear, angular], axis=2).transpose(0, 2, 1)


def manipulabilities(chain: SlidingChain, q: np.ndarray) -> np.ndarray:
    """w = sqrt(det(J J^T)) as the product of the singular values of J, (N, n) -> (N,)."""
    values = np.linalg.svd(jacobians(chain, q), compute_uv=False)
    return values.prod(axis=1) if q.shape[1] >= 6 else np.zeros(len(q))
