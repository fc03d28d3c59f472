"""Distances between link axes, the line segments within the capsules, and nearest points."""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from .kinematics import core_distances, joint_frames
from .system import ArmSystem


def largest_thickness(system: ArmSystem) -> float:
    """Sum of the radii of the two thickest links of different arms that move [m]."""
    arrays = system.arrays
    moving = arrays.first < arrays.last
    sums = [arrays.radius[[i, j]].sum() for i, j in arrays.pairs if moving[i] and moving[j]]
    return float(max(sums, default=0.0))


def axis_distances(system: ArmSystem, q: np.ndarray) -> np.ndarray:
    """Smallest distance of two watched axes at each of N configurations (N, n): (N,) [m]."""
    found = np.empty(len(q))
    _smallest(system.arrays, np.ascontiguousarray(q), found)
    return found


def nearest_points(system: ArmSystem, q: np.ndarray) -> np.ndarray:
    """Nearest points (2, 3) of the surfaces of the watched pair that is nearest [m].

    Where links overlap, each is the deepest point within the other link.
    """
    arrays = system.arrays
    pairs = len(arrays.pairs)
    frames = np.empty((arrays.start[-1] + len(arrays.base), 3, 4))
    tips = np.empty((len(arrays.base), 3))
    distance, witness = np.empty(pairs), np.empty((pairs, 3, 3))
    joint_frames(arrays, np.ascontiguousarray(q), frames, tips)
    core_distances(arrays, frames, distance, witness)
    radii = arrays.radius[arrays.pairs]
    k = int((distance - radii.sum(axis=1)).argmin())
    first, second, normal = witness[k]
    return np.array([first + radii[k, 0] * normal, second - radii[k, 1] * normal])


@kernel
def _smallest(arrays, q, found):
    n, arms, pairs = arrays.start[-1], len(arrays.base), len(arrays.pairs)
    frames, tips = np.empty((n + arms, 3, 4)), np.empty((arms, 3))
    distance, witness = np.empty(pairs), np.empty((pairs, 3, 3))
    for k in range(len(q)):
        joint_frames(arrays, q[k], frames, tips)
        core_distances(arrays, frames, distance, witness)
        found[k] = distance.min() if pairs else np.inf
