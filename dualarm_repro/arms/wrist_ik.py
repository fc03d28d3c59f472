"""Closed-form inverse kinematics of six revolute joints with a spherical wrist.

The wrist centre W = p - R d depends on q1, q2, q3 only: axis 1 turns the vertical plane of the
arm, in which upper arm and forearm form a planar 2R chain; the rotation that is left then gives the
three angles of the wrist (D. L. Pieper, The kinematics of manipulators under computer control,
1968). Two signs at shoulder, elbow and wrist make the eight branches. The four arms of a pose are
lanes of SIMD code (:mod:`.wrist_lanes`); every angle is found as a pair of sine and cosine, and of
two wrists with perpendicular axes one gives the other.
"""

from __future__ import annotations

import math

import numpy as np

from ..kernel import COMPILES, kernel
from .codegen.simd import STORES, WIDTH
from .trigonometry import arctan2
from .wrist_lanes import (
    ANGLES,
    ARMS,
    COSINES,
    FOUND,
    LANES,
    LOWER,
    NEAR,
    POSE,
    SINES,
    SIZE,
    SQUARE,
    UPPER,
    angles,
    branches,
    directions,
    representative,
)

BRANCHES = 8  # index 4 (shoulder back) + 2 (elbow negative) + (wrist negative)
SAME = 1e-6  # half the difference [rad] below which the angles of two branches are one
_store_8, _store_4 = STORES[8], STORES[4]


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
    w = np.zeros(SIZE)
    for k in range(9):  # q1 ... q6, and q4, q5, q6 of the other wrist
        j = k if k < 6 else k - 3
        for i in range(k * LANES, (k + 1) * LANES):
            w[NEAR + i], w[LOWER + i], w[UPPER + i] = reference[j], lower[j], upper[j]
    s2, c2, turn = math.sin(reference[1]), math.cos(reference[1]), geometry.turn
    _, rise, run = geometry.upper_arm
    undetermined = (
        (math.sin(reference[0]), math.cos(reference[0])),
        (s2, c2),
        (s2 * run + c2 * rise, c2 * run - s2 * rise),
        (math.sin(reference[3]), math.cos(reference[3])),
    )
    twice = math.atan2(2.0 * turn[0] * turn[1], turn[1] * turn[1] - turn[0] * turn[0])
    perpendicular = abs(geometry.twists[0][1]) < SQUARE and abs(geometry.twists[1][1]) < SQUARE
    arctangents = (6 if perpendicular else 8) * LANES
    for start in range(0, ARMS * len(poses), LANES):  # of a lane come twice six angles in a row
        for k in range(LANES // ARMS):
            pose = poses[min(start // ARMS + k, len(poses) - 1)]
            for e in range(12):
                entry = pose[e // 4, e % 4]
                for i in range(ARMS):
                    w[POSE + e * LANES + k * ARMS + i] = entry
        for i in range(LANES):
            directions(geometry, undetermined, w, i)
        for i in range(arctangents):
            w[SINES + i] = arctan2(w[SINES + i], w[COSINES + i])
        for i in range(LANES):
            angles(geometry.elbow_sign, twice, perpendicular, w, i)
        for i in range(9 * LANES):
            w[ANGLES + i] = representative(w[ANGLES + i], w[NEAR + i], w[LOWER + i], w[UPPER + i])
        for i in range(LANES):
            branches(w, i)
        if COMPILES and 12 * (start + LANES) <= flat.size:
            for i in range(0, LANES, WIDTH):
                to = 12 * (start + i)
                _store_8(w, FOUND + i, LANES, flat, to, 12)
                _store_4(w, FOUND + 8 * LANES + i, LANES, flat, to + 8, 12)
        else:
            for k in range(min(12 * LANES, flat.size - 12 * start)):
                flat[12 * start + k] = w[FOUND + k % 12 * LANES + k // 12]
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
