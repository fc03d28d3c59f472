"""The steps of :mod:`.wrist_ik` for ``LANES`` arms at once, as loops that become SIMD code.

A lane is one arm of one pose: 2 (shoulder back) + (elbow negative). All that the lanes need lies in
one buffer, at constant places of ``LANES`` numbers each, which are named below.
"""

from __future__ import annotations

import math

import numpy as np

from ..kernel import inlined

LANES = 8
ARMS = 4
SINGULAR = 1e-11  # sine below which an angle is undetermined and its reference is taken
BOUNDARY = 1e-12  # relative overshoot of a square that rounding is allowed
ON_LIMIT = 1e-11  # overshoot of a joint limit [rad] that is clipped
SQUARE = 1e-15  # cosine up to which two axes of the wrist count as perpendicular
_TIE = 1e-9  # of a turn: half a turn away from the reference is taken on the upper side
_TURN, _TURNS = 2.0 * math.pi, 0.5 / math.pi

POSE = 0  # 12: the first three rows of the pose
_EXISTS, _LENGTH = 12 * LANES, 13 * LANES  # 1 or 0; square of the sine that q4 is found from
# What an angle is the arctangent of, and in the place of the former then the angle, of q1, q2, the
# pitch q2 +- q3, q5, q4, q6 and q4, q6 of the other wrist.
SINES = 14 * LANES
_Y1, _Y2, _Y3, _Y5, _Y4, _Y6, _Z4, _Z6 = (SINES + k * LANES for k in range(8))
COSINES = 22 * LANES
_X1, _X2, _X3, _X5, _X4, _X6, _W4, _W6 = (COSINES + k * LANES for k in range(8))
ANGLES = 30 * LANES  # 9: q1 ... q6 and q4, q5, q6 of the other wrist
_Q1, _Q2, _Q3, _Q4, _Q5, _Q6, _P4, _P5, _P6 = (ANGLES + k * LANES for k in range(9))
NEAR, LOWER, UPPER = 39 * LANES, 48 * LANES, 57 * LANES  # of these angles
FOUND = 66 * LANES  # 12: the angles of both wrists, NaN where there is no branch
SIZE = 78 * LANES


@inlined
def directions(geometry, undetermined, w, i):
    """Multiples of sine and cosine of what the angles of an arm and of its wrists are found from.

    ``undetermined`` has sine and cosine of the references of q1, of q2, of q2 from the upper arm
    on and of q4.
    """
    R = (
        (w[i], w[LANES + i], w[2 * LANES + i]),
        (w[4 * LANES + i], w[5 * LANES + i], w[6 * LANES + i]),
        (w[8 * LANES + i], w[9 * LANES + i], w[10 * LANES + i]),
    )
    o = geometry.origin
    p = (w[3 * LANES + i] - o[0], w[7 * LANES + i] - o[1], w[11 * LANES + i] - o[2])
    p, back = _times(geometry.base, p), _times(geometry.base, _times(R, geometry.flange[2]))
    centre = (p[0] - back[0], p[1] - back[1], p[2] - back[2])
    s1, c1, s2, c2, s, c, reached = _arm(geometry, undetermined, centre, i & 2, i & 1)
    w[_Y1 + i], w[_X1 + i] = s1, c1
    w[_Y2 + i], w[_X2 + i] = s2, c2
    w[_Y3 + i], w[_X3 + i] = s, c
    tool = _times(geometry.base, _times(R, geometry.flange[0]))
    normal = _times(geometry.base, _times(R, geometry.flange[1]))
    z6 = _times(geometry.wrist, _turned_back(s1, c1, s, c, tool))
    x5 = _times(geometry.wrist, _turned_back(s1, c1, s, c, normal))
    (sa, ca), (sb, cb) = geometry.twists
    square = z6[0] * z6[0] + z6[1] * z6[1] - ca * ca - cb * cb + 2.0 * ca * cb * z6[2]
    w[_EXISTS + i] = 1.0 if reached & (square > -BOUNDARY) else 0.0
    scale = 1.0 / (sa * sb)
    sine = -math.sqrt(square if square > 0.0 else 0.0) * scale
    cosine = (ca * cb - z6[2]) * scale
    w[_Y5 + i], w[_X5 + i] = _sum(sine, cosine, -geometry.turn[0], geometry.turn[1])
    y4, x4, y6, x6, length = _wrist(geometry.twists, undetermined[3], z6, x5, sine, cosine)
    w[_Y4 + i], w[_X4 + i], w[_Y6 + i], w[_X6 + i], w[_LENGTH + i] = y4, x4, y6, x6, length
    y4, x4, y6, x6, length = _wrist(geometry.twists, undetermined[3], z6, x5, -sine, cosine)
    w[_Z4 + i], w[_W4 + i], w[_Z6 + i], w[_W6 + i] = y4, x4, y6, x6


@inlined
def _arm(geometry, undetermined, centre, backward, negative):
    """Sine and cosine of q1, q2 and the pitch q2 +- q3 for the wrist centre, if it is in reach."""
    l2, l3 = geometry.upper_arm[0], geometry.forearm[0]
    slack = BOUNDARY * ((l2 + l3) * (l2 + l3))
    b = geometry.lateral * geometry.lateral
    around = centre[0] * centre[0] + centre[1] * centre[1]
    radius = math.sqrt(around - b if around > b else 0.0)
    radius = -radius if backward else radius
    s1 = (centre[1] * radius - centre[0] * geometry.lateral) / around
    c1 = (centre[0] * radius + centre[1] * geometry.lateral) / around
    s1 = s1 if around > slack * SINGULAR else undetermined[0][0]
    c1 = c1 if around > slack * SINGULAR else undetermined[0][1]

    x, z = radius - geometry.shoulder[0], centre[2] - geometry.shoulder[1]
    square = x * x + z * z
    distance = math.sqrt(square)
    unbent = (l2 + l3 - distance) * (l2 + l3 + distance)
    folded = (distance - l2 + l3) * (distance + l2 - l3)
    bent = (unbent if unbent > 0.0 else 0.0) * (folded if folded > 0.0 else 0.0)
    sine = math.sqrt(bent) / (2.0 * l2 * l3)
    sine = -sine if negative else sine
    cosine = (folded - unbent) / (4.0 * l2 * l3)
    ahead, behind = l2 + l3 * cosine, l3 * sine
    s, c = (x * ahead - z * behind) / square, (z * ahead + x * behind) / square
    s2, c2 = _sum(s, c, -geometry.upper_arm[1], geometry.upper_arm[2])
    s2 = s2 if square > slack * SINGULAR else undetermined[1][0]
    c2 = c2 if square > slack * SINGULAR else undetermined[1][1]
    s = s if square > slack * SINGULAR else undetermined[2][0]
    c = c if square > slack * SINGULAR else undetermined[2][1]
    s, c = _sum(s, c, sine, cosine)
    s, c = _sum(s, c, -geometry.forearm[1], geometry.forearm[2])
    reached = (around > b - slack) & (unbent > -slack) & (folded > -slack)
    return s1, c1, s2, c2, s, c, reached


@inlined
def _wrist(twists, aligned, z6, x5, sine, cosine):
    """Multiples of sine and cosine of q4 and q6 that turn z6 and x5 into these vectors, and the
    square of the former multiple.

    In the frame x4, y4, z4 the wrist is Rz(q4) Rx(a) Rz(q5 + turn) Rx(b) Rz(q6), with twists a, b.
    """
    (sa, ca), (sb, cb) = twists
    u, v = sb * sine, -ca * sb * cosine - sa * cb
    length = u * u + v * v
    s4, c4 = u * z6[1] - v * z6[0], u * z6[0] + v * z6[1]
    s4 = s4 if length > SINGULAR * SINGULAR else aligned[0]
    c4 = c4 if length > SINGULAR * SINGULAR else aligned[1]
    x, y = c4 * x5[0] + s4 * x5[1], c4 * x5[1] - s4 * x5[0]
    z = x5[2] * (length if length > SINGULAR * SINGULAR else 1.0)
    # Columns of Rx(a) Rz(q5 + turn) Rx(b).
    y6 = -cb * sine * x + (ca * cb * cosine - sa * sb) * y + (sa * cb * cosine + ca * sb) * z
    x6 = cosine * x + ca * sine * y + sa * sine * z
    return s4, c4, y6, x6, length


@inlined
def angles(elbow_sign, turn, perpendicular, w, i):
    """The six angles of an arm and the last three with the other wrist, up to full turns.

    With perpendicular axes the other wrist has q4 and q6 half a turn further and q5 mirrored.
    """
    q4, q5, q6 = w[_Y4 + i], w[_Y5 + i], w[_Y6 + i]
    half = math.pi if w[_LENGTH + i] > SINGULAR * SINGULAR else 0.0
    w[_Q1 + i], w[_Q2 + i], w[_Q3 + i] = (
        w[_Y1 + i],
        w[_Y2 + i],
        elbow_sign * (w[_Y3 + i] - w[_Y2 + i]),
    )
    w[_Q4 + i], w[_Q5 + i], w[_Q6 + i] = q4, q5, q6
    w[_P4 + i] = q4 + (-half if q4 > 0.0 else half) if perpendicular else w[_Z4 + i]
    w[_P5 + i] = -q5 - turn
    w[_P6 + i] = q6 + (-half if q6 > 0.0 else half) if perpendicular else w[_Z6 + i]


@inlined
def representative(angle, near, lower, upper):
    """Of the angles that differ by full turns the one nearest to the reference, then shifted by
    full turns into the limits; NaN if none fits."""
    angle += _TURN * np.floor((near - angle) * _TURNS + 0.5 + _TIE)
    over = np.ceil((angle - (upper + ON_LIMIT)) * _TURNS)
    angle -= _TURN * (over if over > 0.0 else 0.0)
    under = np.ceil((lower - ON_LIMIT - angle) * _TURNS)
    angle += _TURN * (under if under > 0.0 else 0.0)
    inside = angle <= upper + ON_LIMIT
    angle = lower if angle < lower else angle
    angle = upper if angle > upper else angle
    return angle if inside else np.nan


@inlined
def branches(w, i):
    """The angles of an arm with both wrists, NaN for all six where there is no such branch."""
    arm = w[_Q1 + i] + w[_Q2 + i] + w[_Q3 + i] if w[_EXISTS + i] > 0.0 else np.nan
    one = arm + w[_Q4 + i] + w[_Q5 + i] + w[_Q6 + i]  # NaN if an angle is
    other = arm + w[_P4 + i] + w[_P5 + i] + w[_P6 + i]
    for j in range(6):
        q = w[_Q1 + j * LANES + i]
        w[FOUND + j * LANES + i] = q if one == one else np.nan
    for j in range(3):
        q, p = w[_Q1 + j * LANES + i], w[_P4 + j * LANES + i]
        w[FOUND + (6 + j) * LANES + i] = q if other == other else np.nan
        w[FOUND + (9 + j) * LANES + i] = p if other == other else np.nan


@inlined
def _sum(s, c, sine, cosine):
    """Sine and cosine of the sum of two angles."""
    return s * cosine + c * sine, c * cosine - s * sine


@inlined
def _turned_back(s1, c1, s, c, v):
    """Ry(-pitch) Rz(-q1) v."""
    x, y = c1 * v[0] + s1 * v[1], c1 * v[1] - s1 * v[0]
    return (c * x - s * v[2], y, s * x + c * v[2])


@inlined
def _times(rows, v):
    """The product of a matrix and a vector."""
    a, b, c = rows
    x, y, z = v
    return (
        a[0] * x + a[1] * y + a[2] * z,
        b[0] * x + b[1] * y + b[2] * z,
        c[0] * x + c[1] * y + c[2] * z,
    )
