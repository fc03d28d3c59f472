"""Kinematics and distances of all arms of a system at one configuration, compiled.

Written for one configuration at a time, as a controller needs them; the yardstick of the tests is
:func:`..scene.gradients.clearance_gradient` and the arms' own Jacobian.
"""

from __future__ import annotations

import numpy as np

from ..arms.chain import Chain
from ..kernel import kernel
from ..scene.posing import link_frames
from ..scene.segments import segment_segment
from ..scene.vectors import cross, minus, vector


@kernel
def joint_frames(arrays, q, frames, tips):
    """Frames of all arms as :func:`..scene.posing.link_frames` has them, and the flange positions.

    Parameters
    ----------
    q : (n,) [rad]
    frames : (n + A, 3, 4), output
        Base and joint frames arm by arm.
    tips : (A, 3), output [m]
    """
    for arm in range(len(arrays.base)):
        first, last = arrays.start[arm], arrays.start[arm + 1]
        row, flange = first + arm, last + arm
        chain = Chain(arrays.rotation[row:flange], arrays.translation[row:flange])
        angles = q[first:last].reshape(1, -1)
        frames[row : flange + 1] = link_frames(chain, arrays.base[arm], angles)[0]
        F, t = frames[flange], arrays.translation[flange]
        for r in range(3):
            tips[arm, r] = F[r, 0] * t[0] + F[r, 1] * t[1] + F[r, 2] * t[2] + F[r, 3]


@kernel
def point_velocity(frames, arm, joint, p):
    """z_j x (p - o_j): velocity of a point per unit speed of a joint of an arm [m]."""
    F = frames[joint + arm + 1]
    return cross(vector(F[:, 2]), minus(p, vector(F[:, 3])))


@kernel
def tip_jacobian(arrays, frames, tips, J):
    """Block-diagonal J (3A, n) of the flange positions, v = J dq [m/rad]."""
    J[:] = 0.0
    for arm in range(len(tips)):
        p = vector(tips[arm])
        for joint in range(arrays.start[arm], arrays.start[arm + 1]):
            v = point_velocity(frames, arm, joint, p)
            for r in range(3):
                J[3 * arm + r, joint] = v[r]


@kernel
def core_distances(arrays, frames, distance, witness):
    """Distance of the capsule cores of every pair, nearest points and normal from a to b.

    Parameters
    ----------
    distance : (P,), output [m]
        Between the cores; the radii are left to the caller.
    witness : (P, 3, 3), output
        Point on core a, point on core b, unit normal.
    """
    cores = np.empty((len(arrays.radius), 2, 3))
    for c in range(len(cores)):
        F = frames[arrays.frame[c]]
        for end in range(2):
            x, y, z = vector(arrays.local[c, end])
            for r in range(3):
                cores[c, end, r] = F[r, 0] * x + F[r, 1] * y + F[r, 2] * z + F[r, 3]
    for k in range(len(distance)):
        i, j = arrays.pairs[k]
        a, b = vector(cores[i, 0]), vector(cores[j, 0])
        u, v = minus(vector(cores[i, 1]), a), minus(vector(cores[j, 1]), b)
        gap, p, q, normal = segment_segment(a, u, b, v)
        distance[k] = gap
        for r in range(3):
            witness[k, 0, r], witness[k, 1, r], witness[k, 2, r] = p[r], q[r], normal[r]


@kernel
def relative_velocity(arrays, frames, body, point, sign, columns):
    """Add sign times the velocity of a point of a body per joint speed to ``columns`` (3, n)."""
    p = vector(point)
    first = arrays.first[body]
    arm = arrays.frame[body] - arrays.last[body]
    for joint in range(first, arrays.last[body]):
        v = point_velocity(frames, arm, joint, p)
        for r in range(3):
            columns[r, joint] += sign * v[r]
