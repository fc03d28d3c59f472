"""Closed-form inverse kinematics of six revolute joints with a spherical wrist.

The wrist centre W = p - R d depends on q1, q2, q3 only: axis 1 turns the vertical plane of the
arm, in which upper arm and forearm form a planar 2R chain; the rotation that is left then gives the
three angles of the wrist (D. L. Pieper, The kinematics of manipulators under computer control,
1968). Two signs at shoulder, elbow and wrist make the eight branches. Every angle is found as a
pair of sine and cosine; the arctangents come last, in one loop.
"""

from __future__ import annotations

import math

import numpy as np

from ..kernel import kernel
from .codegen.simd import STORES
from .wrist_lanes import BRANCHES, LANES, OUT, POSE, prepared, solve

SAME = 1e-6  # half the difference [rad] below which the angles of two branches are one
store_4, store_2 = STORES[4], STORES[2]


@kernel
def inverse_kinematics(geometry, poses, reference, lower, upper):
    """All branches for every flange pose.

    Parameters
    ----------
    geometry : WristGeometry
    poses : ndarray (N, 4, 4)
    reference : ndarray (6,)
        Angles [rad]: each joint is the representative nearest to it, and equals it where
        undetermined (q1 with the wrist centre on axis 1, q2 with it on axis 2, q4 with aligned
        axes 4 and 6).
    lower, upper : ndarray (6,)
        Limits [rad]; infinite ones allow every angle.

    Returns
    -------
    ndarray (N, 8, 6)
        NaN where a branch does not exist or has no representative within the limits.
    """
    out = np.empty((len(poses), BRANCHES, 6))
    flat = out.reshape(-1)
    w = prepared(reference, lower, upper)
    for start in range(0, len(poses), LANES):
        rows = min(LANES, len(poses) - start)
        for i in range(LANES):
            k = start + min(i, rows - 1)
            for r in range(3):
                for c in range(4):
                    w[POSE + (4 * r + c) * LANES + i] = poses[k, r, c]
        solve(geometry, reference, w)
        for b in range(BRANCHES):
            shoulder, elbow, wrist = b >> 2, b >> 1 & 1, b & 1
            at, to = OUT + (24 * wrist + 2 * elbow + shoulder) * LANES, (start * BRANCHES + b) * 6
            if rows == LANES:
                store_4(w, at, 4 * LANES, flat, to, 48)
                store_2(w, at + 16 * LANES, 4 * LANES, flat, to + 4, 48)
            else:
                for i in range(rows):
                    for j in range(6):
                        flat[to + 48 * i + j] = w[at + 4 * j * LANES + i]
    return out


@kernel
def distinct(branches):
    """Which of the branches (8, 6) of one pose exist and equal no earlier one, (8,) of bool."""
    keep = np.zeros(BRANCHES, dtype=np.bool_)
    for b in range(BRANCHES):
        keep[b] = not np.isnan(branches[b, 0])
        for other in range(b):
            apart = 0.0
            for j in range(6):
                apart = max(apart, abs(math.sin(0.5 * (branches[b, j] - branches[other, j]))))
            keep[b] &= not (keep[other] and apart < SAME)
    return keep


