"""The closed form one pose after the other, in plain Python: what the lanes are compared with."""

from __future__ import annotations

import math

import numpy as np

BRANCHES = 8  # index 4 (shoulder back) + 2 (elbow negative) + (wrist negative)
SINGULAR = 1e-11  # sine below which an angle is undetermined and its reference is taken
BOUNDARY = 1e-12  # relative overshoot of a square that rounding is allowed
ON_LIMIT = 1e-11  # overshoot of a joint limit [rad] that is clipped
_TIE = 1e-9  # of a turn: half a turn away from the reference is taken on the upper side
_TURN = 2.0 * math.pi


def inverse_kinematics(geometry, poses, reference, lower, upper):
    """What :func:`dualarm_repro.arms.wrist_ik.inverse_kinematics` promises."""
    out = np.empty((len(poses), BRANCHES, 6))
    sine, cosine, angle = np.empty(6 * BRANCHES), np.empty(6 * BRANCHES), np.empty(6 * BRANCHES)
    near = np.empty(6 * BRANCHES)
    for i in range(6 * BRANCHES):
        near[i] = reference[i % 6]
    exists = np.empty(BRANCHES, dtype=np.bool_)
    for k in range(len(poses)):
        centre = _wrist_centre(geometry, poses, k)
        tool = _from_flange(geometry, poses, k, geometry.flange[0])
        normal = _from_flange(geometry, poses, k, geometry.flange[1])
        for arm in range(BRANCHES // 2):
            s1, c1, s2, c2, s, c, reached = _arm_angles(geometry, centre, arm, reference)
            z6 = _undo_arm(geometry, s1, c1, s, c, tool)
            x5 = _undo_arm(geometry, s1, c1, s, c, normal)
            for b in range(2 * arm, 2 * arm + 2):
                s4, c4, s5, c5, s6, c6, real = _wrist_angles(geometry, z6, x5, b, reference)
                for j, pair in enumerate(
                    ((s1, c1), (s2, c2), (s, c), (s4, c4), (s5, c5), (s6, c6))
                ):
                    sine[6 * b + j], cosine[6 * b + j] = pair
                exists[b] = reached & real
        for i in range(6 * BRANCHES):
            angle[i] = math.atan2(sine[i] + 0.0, cosine[i])
        for b in range(BRANCHES):  # the third angle is the pitch of the forearm, q2 +- q3
            angle[6 * b + 2] = geometry.elbow_sign * (angle[6 * b + 2] - angle[6 * b + 1])
        for i in range(6 * BRANCHES):
            angle[i] += _TURN * np.floor((near[i] - angle[i]) / _TURN + 0.5 + _TIE)
        for b in range(BRANCHES):
            within = exists[b]
            for j in range(6):
                q = _into_limits(angle[6 * b + j], lower[j], upper[j])
                within &= not np.isnan(q)
                out[k, b, j] = q
            if not within:
                for j in range(6):
                    out[k, b, j] = np.nan
    return out


def _arm_angles(geometry, centre, arm, reference):
    """Sine and cosine of q1, q2 and the pitch q2 +- q3 for the wrist centre, if it is in reach."""
    l2, l3 = geometry.upper_arm[0], geometry.forearm[0]
    slack = BOUNDARY * (l2 + l3) ** 2
    b = geometry.lateral
    around = centre[0] ** 2 + centre[1] ** 2
    radius = math.sqrt(max(around - b * b, 0.0))
    radius = -radius if arm & 2 else radius
    if around > slack * SINGULAR:
        s1 = (centre[1] * radius - centre[0] * b) / around
        c1 = (centre[0] * radius + centre[1] * b) / around
    else:
        s1, c1 = math.sin(reference[0]), math.cos(reference[0])

    x, z = radius - geometry.shoulder[0], centre[2] - geometry.shoulder[1]
    square = x * x + z * z
    distance = math.sqrt(square)
    unbent = (l2 + l3 - distance) * (l2 + l3 + distance)
    folded = (distance - l2 + l3) * (distance + l2 - l3)
    sine = math.sqrt(max(unbent, 0.0) * max(folded, 0.0)) / (2.0 * l2 * l3)
    sine = -sine if arm & 1 else sine
    cosine = (folded - unbent) / (4.0 * l2 * l3)
    if square > slack * SINGULAR:
        ahead, behind = l2 + l3 * cosine, l3 * sine
        s, c = (x * ahead - z * behind) / square, (z * ahead + x * behind) / square
        s2, c2 = _sum(s, c, -geometry.upper_arm[1], geometry.upper_arm[2])
    else:
        s2, c2 = math.sin(reference[1]), math.cos(reference[1])
        s, c = _sum(s2, c2, geometry.upper_arm[1], geometry.upper_arm[2])
    s, c = _sum(s, c, sine, cosine)
    s, c = _sum(s, c, -geometry.forearm[1], geometry.forearm[2])
    reached = (around > b * b - slack) & (unbent > -slack) & (folded > -slack)
    return s1, c1, s2, c2, s, c, reached


def _wrist_angles(geometry, tool, x5, branch, reference):
    """Sine and cosine of q4, q5, q6 that turn z6 and x5 into these vectors, if they are real.

    In the frame x4, y4, z4 the wrist is Rz(q4) Rx(a) Rz(q5 + turn) Rx(b) Rz(q6), with twists a, b.
    """
    (sa, ca), (sb, cb) = geometry.twists
    across = tool[0] ** 2 + tool[1] ** 2
    square = across - ca * ca - cb * cb + 2.0 * ca * cb * tool[2]
    sine, cosine = math.sqrt(max(square, 0.0)) / (sa * sb), (ca * cb - tool[2]) / (sa * sb)
    sine = sine if branch & 1 else -sine
    # Columns of Rx(a) Rz(q5 + turn) Rx(b).
    m0 = (cosine, ca * sine, sa * sine)
    m1 = (-cb * sine, ca * cb * cosine - sa * sb, sa * cb * cosine + ca * sb)
    u, v = sb * sine, -ca * sb * cosine - sa * cb
    length = u * u + v * v
    if length > SINGULAR**2:
        s4, c4 = (u * tool[1] - v * tool[0]) / length, (u * tool[0] + v * tool[1]) / length
    else:
        s4, c4 = math.sin(reference[3]), math.cos(reference[3])
    w = (c4 * x5[0] + s4 * x5[1], c4 * x5[1] - s4 * x5[0], x5[2])
    s5, c5 = _sum(sine, cosine, -geometry.turn[0], geometry.turn[1])
    return s4, c4, s5, c5, _dot(m1, w), _dot(m0, w), square > -BOUNDARY


def _into_limits(angle, lower, upper):
    """The angle shifted by full turns into its limits, NaN if none fits."""
    while angle > upper + ON_LIMIT:
        angle -= _TURN
    while angle < lower - ON_LIMIT:
        angle += _TURN
    return min(max(angle, lower), upper) if angle <= upper + ON_LIMIT else np.nan


def _sum(s, c, sine, cosine):
    """Sine and cosine of the sum of two angles."""
    return s * cosine + c * sine, c * cosine - s * sine


def _undo_arm(geometry, s1, c1, s, c, v):
    """Ry(-pitch) Rz(-q1) v, in the frame x4, y4, z4."""
    x, y = c1 * v[0] + s1 * v[1], c1 * v[1] - s1 * v[0]
    turned = (c * x - s * v[2], y, s * x + c * v[2])
    x4, y4, z4 = geometry.wrist
    return (_dot(x4, turned), _dot(y4, turned), _dot(z4, turned))


def _wrist_centre(geometry, poses, k):
    d = _from_flange(geometry, poses, k, geometry.flange[2])
    p = _from_base(
        geometry,
        poses[k, 0, 3] - geometry.origin[0],
        poses[k, 1, 3] - geometry.origin[1],
        poses[k, 2, 3] - geometry.origin[2],
    )
    return (p[0] - d[0], p[1] - d[1], p[2] - d[2])


def _from_flange(geometry, poses, k, vector):
    """A vector of the flange frame in the frame of the geometry."""
    f0, f1, f2 = vector
    return _from_base(
        geometry,
        poses[k, 0, 0] * f0 + poses[k, 0, 1] * f1 + poses[k, 0, 2] * f2,
        poses[k, 1, 0] * f0 + poses[k, 1, 1] * f1 + poses[k, 1, 2] * f2,
        poses[k, 2, 0] * f0 + poses[k, 2, 1] * f1 + poses[k, 2, 2] * f2,
    )


def _from_base(geometry, x, y, z):
    """A vector of the base frame in the frame of the geometry."""
    X, Y, Z = geometry.base
    v = (x, y, z)
    return (_dot(X, v), _dot(Y, v), _dot(Z, v))


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
