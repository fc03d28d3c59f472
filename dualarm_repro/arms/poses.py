"""Homogeneous poses, and the checks of poses and configurations that come from outside."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..annotation import real_array
from ..errors import ConfigurationError, InputError
from ..kernel import kernel

ORTHONORMAL = 1e-6  # largest error of R^T R - I that counts as rounding


def homogeneous(rotation: ArrayLike, translation: ArrayLike) -> np.ndarray:
    """Poses (..., 4, 4) of rotations (..., 3, 3) and translations that broadcast to (..., 3)."""
    R = np.asarray(rotation)
    poses = np.zeros((*R.shape[:-2], 4, 4))
    poses[..., :3, :3], poses[..., :3, 3], poses[..., 3, 3] = R, translation, 1.0
    return poses


def check_poses(source: str, T: ArrayLike, ndim: int) -> np.ndarray:
    """``T`` as a float64 array (4, 4) or (N, 4, 4) of rigid motions.

    Raises
    ------
    InputError
        Wrong shape, NaN or infinity, no right-handed rotation, last row not 0, 0, 0, 1.
    """
    shape = "(4, 4)" if ndim == 2 else "(N, 4, 4)"
    expected = f"{shape} finite numbers, rotation and translation [m]"
    try:
        poses = np.ascontiguousarray(real_array(T))
    except (TypeError, ValueError):
        raise InputError(source, "T", T, expected) from None
    if poses.ndim != ndim or poses.shape[-2:] != (4, 4):
        raise InputError(source, "shape of T", poses.shape, expected)
    stack = poses.reshape(-1, 4, 4)
    wrong = _first_wrong(stack)
    if wrong >= 0:
        expected = "a finite right-handed rotation and translation with the last row 0, 0, 0, 1"
        raise InputError(source, "T", stack[wrong].tolist(), expected)
    return poses


def check_configurations(source: str, q: ArrayLike, nq: int, expected: str) -> np.ndarray:
    """``q`` as a float64 array (nq,) or (N, nq).

    Raises
    ------
    ConfigurationError
        Wrong shape, NaN or infinity.
    """
    try:
        array = real_array(q)
    except (TypeError, ValueError):
        raise ConfigurationError(source, "q", q, expected) from None
    if array.ndim not in (1, 2) or array.shape[-1] != nq:
        raise ConfigurationError(source, "shape of q", array.shape, expected)
    if not np.isfinite(array).all():
        raise ConfigurationError(source, "q", float(array[~np.isfinite(array)][0]), expected)
    return array


@kernel
def _first_wrong(poses):
    """Index of the first matrix that is no pose, -1 if there is none."""
    for k in range(len(poses)):
        T = poses[k]
        for i in range(3):
            a, b, c = T[i, 0], T[i, 1], T[i, 2]
            m, n = (i + 1) % 3, (i + 2) % 3
            # Row i is of unit length and the cross product of the other two.
            x = T[m, 1] * T[n, 2] - T[m, 2] * T[n, 1]
            y = T[m, 2] * T[n, 0] - T[m, 0] * T[n, 2]
            z = T[m, 0] * T[n, 1] - T[m, 1] * T[n, 0]
            error = max(abs(a - x), abs(b - y), abs(c - z), abs(a * a + b * b + c * c - 1.0))
            if not (error < ORTHONORMAL and np.isfinite(T[i, 3])):
                return k
        if T[3, 0] != 0.0 or T[3, 1] != 0.0 or T[3, 2] != 0.0 or T[3, 3] != 1.0:
            return k
    return -1
