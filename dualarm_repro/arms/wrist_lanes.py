"""The stages of :mod:`.wrist_ik` for a block of ``LANES`` poses, as loops that become SIMD code.

All that a block needs lies in one buffer at constant places, in rows of ``LANES`` numbers; rows of
one quantity follow each other: of the two shoulders (front, back), of the four arms (elbow positive
with both shoulders, elbow negative with both) and of the two wrists (negative sine with all arms,
positive sine with all arms). Numbers of places below are the first of their quantity.
"""

from __future__ import annotations

import math

import numpy as np

from ..kernel import inlined, kernel
from .trigonometry import arctan2

LANES = 8
BRANCHES = 8
SINGULAR = 1e-11  # sine below which an angle is undetermined and its reference is taken
BOUNDARY = 1e-12  # relative overshoot of a square that rounding is allowed
ON_LIMIT = 1e-11  # overshoot of a joint limit [rad] that is clipped
SKEW = 1e-15  # cosine up to which axes of the wrist count as perpendicular
_TIE = 1e-9  # of a turn: half a turn away from the reference is taken on the upper side
_TURN = 2.0 * math.pi

_1, _2, _4 = LANES, 2 * LANES, 4 * LANES
_SHOULDERS, _ARMS = 2 * LANES, 4 * LANES
POSE = 0  # 12 rows of the first three rows of a pose
_TOOL = POSE + 12 * _1  # z6 and x5 in the frame of the geometry, for each arm
_NORMAL = _TOOL + 3 * _4
_CENTRE = _NORMAL + 3 * _4  # of the wrist, for each shoulder; the square of its way from axis 1
_RADIUS = _CENTRE + 4 * _2  # and its way from axis 1 in the plane of the arm
_TURNED = _RADIUS + _2  # s1, c1 and sine and cosine of the pitch, for each arm
_EXISTS = _TURNED + 4 * _4  # 1 where an arm reaches, else 0
_SIZE = _EXISTS + _4  # per shoulder the square of the wrist's way from axis 2
_REGULAR = _SIZE + _2  # per arm the square of the sine that q4 is found from
_Y = _REGULAR + _4  # 28 rows each of what angles are the arctangents of, and of these angles:
_X = _Y + 28 * _1  # q1, to the wrist, at the shoulder and of the elbow for each shoulder,
_ANGLE = _X + 28 * _1  # q5 for each arm, q4 and q6 for each arm, q4 and q6 with the other wrist
_JOINT = _ANGLE + 28 * _1  # 36 rows: q1, q2, q3 per arm, q4, q5, q6 per wrist
_NEAR = _JOINT + 36 * _1  # the reference and the limits of these
_LOWER = _NEAR + 36 * _1
_UPPER = _LOWER + 36 * _1
OUT = _UPPER + 36 * _1  # 48 rows: six angles for each of eight branches
SIZE = OUT + 6 * BRANCHES * _1
#: Rows of each joint among the 36.
_ROWS = (0, 4, 8, 12, 20, 28, 36)


@inlined
def prepared(reference, lower, upper):
    """The buffer with reference and limits in place."""
    w = np.zeros(SIZE)
    for j in range(6):
        for i in range(_ROWS[j] * LANES, _ROWS[j + 1] * LANES):
            w[_NEAR + i], w[_LOWER + i], w[_UPPER + i] = reference[j], lower[j], upper[j]
    return w


@inlined
def solve(geometry, reference, w):
    """All branches of the poses in the buffer into its last rows, NaN where there is none."""
    ca, cb = geometry.twists[0][1], geometry.twists[1][1]
    square = abs(ca) < SKEW and abs(cb) < SKEW
    for i in range(LANES):
        _place(geometry, w, i)
    around = math.sin(reference[0]), math.cos(reference[0])
    upright = _sum(
        math.sin(reference[1]), math.cos(reference[1]), geometry.upper_arm[1], geometry.upper_arm[2]
    )
    for j in range(_SHOULDERS):
        _arm(geometry, around, upright, w, j)
    aligned = math.sin(reference[3]), math.cos(reference[3])
    for j in range(_ARMS):
        _wrist(geometry, aligned, w, j)
    if not square:
        for j in range(_ARMS):
            _other_wrist(geometry, aligned, w, j)
    for i in range((20 if square else 28) * LANES):
        w[_ANGLE + i] = arctan2(w[_Y + i], w[_X + i])
    _joints(geometry, reference, square, w)
    for i in range(36 * LANES):
        w[_JOINT + i] = _representative(
            w[_JOINT + i], w[_NEAR + i], w[_LOWER + i], w[_UPPER + i]
        )
    for j in range(_ARMS):
        _branches(w, j)


@inlined
def _place(geometry, w, i):
    """z6, x5 and the wrist centre in the frame of the geometry."""
    flange = geometry.flange
    tool, normal = _from_flange(geometry, w, i, flange[0]), _from_flange(geometry, w, i, flange[1])
    back = _from_flange(geometry, w, i, flange[2])
    p = _from_base(
        geometry,
        w[POSE + 3 * _1 + i] - geometry.origin[0],
        w[POSE + 7 * _1 + i] - geometry.origin[1],
        w[POSE + 11 * _1 + i] - geometry.origin[2],
    )
    x, y, z = p[0] - back[0], p[1] - back[1], p[2] - back[2]
    around = x * x + y * y
    radius = math.sqrt(max(around - geometry.lateral * geometry.lateral, 0.0))
    w[_CENTRE + i], w[_CENTRE + _1 + i] = x, x
    w[_CENTRE + _2 + i], w[_CENTRE + _2 + _1 + i] = y, y
    w[_CENTRE + 2 * _2 + i], w[_CENTRE + 2 * _2 + _1 + i] = z, z
    w[_CENTRE + 3 * _2 + i], w[_CENTRE + 3 * _2 + _1 + i] = around, around
    w[_RADIUS + i], w[_RADIUS + _1 + i] = radius, -radius
    for e in range(3):
        for arm in range(4):
            w[_TOOL + e * _4 + arm * _1 + i] = tool[e]
            w[_NORMAL + e * _4 + arm * _1 + i] = normal[e]


@inlined
def _arm(geometry, front, upright, w, j):
    """Sine and cosine of q1 and of the pitch q2 +- q3 with both elbows, and what the angles of the
    arm are found from."""
    l2, l3 = geometry.upper_arm[0], geometry.forearm[0]
    slack = BOUNDARY * (l2 + l3) ** 2
    b, around, radius = geometry.lateral, w[_CENTRE + 3 * _2 + j], w[_RADIUS + j]
    x, y = w[_CENTRE + j], w[_CENTRE + _2 + j]
    off = around > slack * SINGULAR
    s1 = (y * radius - x * b) / around if off else front[0]
    c1 = (x * radius + y * b) / around if off else front[1]

    x, z = radius - geometry.shoulder[0], w[_CENTRE + 2 * _2 + j] - geometry.shoulder[1]
    square = x * x + z * z
    distance = math.sqrt(square)
    unbent = (l2 + l3 - distance) * (l2 + l3 + distance)
    folded = (distance - l2 + l3) * (distance + l2 - l3)
    sine = math.sqrt(max(unbent, 0.0) * max(folded, 0.0)) / (2.0 * l2 * l3)
    cosine = (folded - unbent) / (4.0 * l2 * l3)
    ahead, behind = l2 + l3 * cosine, l3 * sine
    apart = square > slack * SINGULAR
    s = (x * ahead - z * behind) / square if apart else upright[0]
    c = (z * ahead + x * behind) / square if apart else upright[1]
    s, c = _sum(s, c, sine, cosine)
    s, c = _sum(s, c, -geometry.forearm[1], geometry.forearm[2])
    w[_TURNED + 2 * _4 + j], w[_TURNED + 3 * _4 + j] = s, c
    s = (x * ahead + z * behind) / square if apart else upright[0]
    c = (z * ahead - x * behind) / square if apart else upright[1]
    s, c = _sum(s, c, -sine, cosine)
    s, c = _sum(s, c, -geometry.forearm[1], geometry.forearm[2])
    w[_TURNED + 2 * _4 + _2 + j], w[_TURNED + 3 * _4 + _2 + j] = s, c
    w[_TURNED + j], w[_TURNED + _2 + j] = s1, s1
    w[_TURNED + _4 + j], w[_TURNED + _4 + _2 + j] = c1, c1
    w[_SIZE + j] = square
    reached = (around > b * b - slack) & (unbent > -slack) & (folded > -slack)
    exists = 1.0 if reached else 0.0
    w[_EXISTS + j], w[_EXISTS + _2 + j] = exists, exists
    w[_Y + j], w[_X + j] = s1, c1
    w[_Y + _2 + j], w[_X + _2 + j] = x, z
    w[_Y + 2 * _2 + j], w[_X + 2 * _2 + j] = behind, ahead
    w[_Y + 3 * _2 + j], w[_X + 3 * _2 + j] = sine, cosine


@inlined
def _wrist(geometry, aligned, w, j):
    """What the angles of the wrist are found from, with negative sine."""
    (sa, ca), (sb, cb) = geometry.twists
    s1, c1, s, c = w[_TURNED + j], w[_TURNED + _4 + j], w[_TURNED + 2 * _4 + j], w[_TURNED + 3 * _4 + j]
    z6 = _undo_arm(geometry, s1, c1, s, c, w[_TOOL + j], w[_TOOL + _4 + j], w[_TOOL + 2 * _4 + j])
    x5 = _undo_arm(
        geometry, s1, c1, s, c, w[_NORMAL + j], w[_NORMAL + _4 + j], w[_NORMAL + 2 * _4 + j]
    )
    square = z6[0] * z6[0] + z6[1] * z6[1] - ca * ca - cb * cb + 2.0 * ca * cb * z6[2]
    sine, cosine = -math.sqrt(max(square, 0.0)) / (sa * sb), (ca * cb - z6[2]) / (sa * sb)
    w[_EXISTS + j] = w[_EXISTS + j] if square > -BOUNDARY else 0.0
    s5, c5 = _sum(sine, cosine, -geometry.turn[0], geometry.turn[1])
    w[_Y + 4 * _2 + j], w[_X + 4 * _2 + j] = s5, c5
    y4, x4, y6, x6, length = _turned(geometry, aligned, z6, x5, sine, cosine)
    w[_Y + 4 * _2 + _4 + j], w[_X + 4 * _2 + _4 + j] = y4, x4
    w[_Y + 4 * _2 + 2 * _4 + j], w[_X + 4 * _2 + 2 * _4 + j] = y6, x6
    w[_REGULAR + j] = length
    for e in range(3):
        w[_TOOL + e * _4 + j], w[_NORMAL + e * _4 + j] = z6[e], x5[e]


@inlined
def _other_wrist(geometry, aligned, w, j):
    """The same with positive sine, for axes that are not perpendicular."""
    (sa, ca), (sb, cb) = geometry.twists
    z6 = w[_TOOL + j], w[_TOOL + _4 + j], w[_TOOL + 2 * _4 + j]
    x5 = w[_NORMAL + j], w[_NORMAL + _4 + j], w[_NORMAL + 2 * _4 + j]
    square = z6[0] * z6[0] + z6[1] * z6[1] - ca * ca - cb * cb + 2.0 * ca * cb * z6[2]
    sine, cosine = math.sqrt(max(square, 0.0)) / (sa * sb), (ca * cb - z6[2]) / (sa * sb)
    y4, x4, y6, x6, _ = _turned(geometry, aligned, z6, x5, sine, cosine)
    w[_Y + 4 * _2 + 3 * _4 + j], w[_X + 4 * _2 + 3 * _4 + j] = y4, x4
    w[_Y + 4 * _2 + 4 * _4 + j], w[_X + 4 * _2 + 4 * _4 + j] = y6, x6


@inlined
def _turned(geometry, aligned, z6, x5, sine, cosine):
    """Multiples of sine and cosine of q4 and q6, and the square of the first multiple.

    In the frame x4, y4, z4 the wrist is Rz(q4) Rx(a) Rz(q5 + turn) Rx(b) Rz(q6), with twists a, b.
    """
    (sa, ca), (sb, cb) = geometry.twists
    u, v = sb * sine, -ca * sb * cosine - sa * cb
    length = u * u + v * v
    regular = length > SINGULAR * SINGULAR
    s4 = u * z6[1] - v * z6[0] if regular else aligned[0]
    c4 = u * z6[0] + v * z6[1] if regular else aligned[1]
    x, y = c4 * x5[0] + s4 * x5[1], c4 * x5[1] - s4 * x5[0]
    z = x5[2] * length if regular else x5[2]
    # Columns of Rx(a) Rz(q5 + turn) Rx(b).
    y6 = -cb * sine * x + (ca * cb * cosine - sa * sb) * y + (sa * cb * cosine + ca * sb) * z
    x6 = cosine * x + ca * sine * y + sa * sine * z
    return s4, c4, y6, x6, length


@inlined
def _joints(geometry, reference, square, w):
    """The six angles of all arms and wrists."""
    rise = arctan2(geometry.upper_arm[1], geometry.upper_arm[2])
    bend = rise - arctan2(geometry.forearm[1], geometry.forearm[2])
    slack = BOUNDARY * (geometry.upper_arm[0] + geometry.forearm[0]) ** 2
    st, ct = geometry.turn
    turn = arctan2(2.0 * st * ct, ct * ct - st * st)
    for j in range(_SHOULDERS):
        w[_JOINT + j], w[_JOINT + _2 + j] = w[_ANGLE + j], w[_ANGLE + j]
        up, at, elbow = w[_ANGLE + _2 + j], w[_ANGLE + 2 * _2 + j], w[_ANGLE + 3 * _2 + j]
        apart = w[_SIZE + j] > slack * SINGULAR
        w[_JOINT + _4 + j] = up - at - rise if apart else reference[1]
        w[_JOINT + _4 + _2 + j] = up + at - rise if apart else reference[1]
        w[_JOINT + 2 * _4 + j] = geometry.elbow_sign * (bend + elbow)
        w[_JOINT + 2 * _4 + _2 + j] = geometry.elbow_sign * (bend - elbow)
    for j in range(_ARMS):
        q5, q4, q6 = (
            w[_ANGLE + 4 * _2 + j],
            w[_ANGLE + 4 * _2 + _4 + j],
            w[_ANGLE + 4 * _2 + 2 * _4 + j],
        )
        other4, other6 = w[_ANGLE + 4 * _2 + 3 * _4 + j], w[_ANGLE + 4 * _2 + 4 * _4 + j]
        half = math.pi if w[_REGULAR + j] > SINGULAR * SINGULAR else 0.0
        half4 = -half if q4 > 0.0 else half
        half6 = -half if q6 > 0.0 else half
        w[_JOINT + 12 * _1 + j] = q4
        w[_JOINT + 16 * _1 + j] = q4 + half4 if square else other4
        w[_JOINT + 20 * _1 + j] = q5
        w[_JOINT + 24 * _1 + j] = -q5 - turn
        w[_JOINT + 28 * _1 + j] = q6
        w[_JOINT + 32 * _1 + j] = q6 + half6 if square else other6


@inlined
def _representative(angle, near, lower, upper):
    """Of the angles that differ by full turns the one nearest to the reference, then shifted into
    the limits; NaN if none fits."""
    angle += _TURN * np.floor((near - angle) / _TURN + 0.5 + _TIE)
    angle -= _TURN * max(np.ceil((angle - (upper + ON_LIMIT)) / _TURN), 0.0)
    angle += _TURN * max(np.ceil((lower - ON_LIMIT - angle) / _TURN), 0.0)
    return min(max(angle, lower), upper) if angle <= upper + ON_LIMIT else np.nan


@inlined
def _branches(w, j):
    """The six angles of both wrists of an arm, or NaN for a branch that lacks one."""
    q1, q2, q3 = w[_JOINT + j], w[_JOINT + _4 + j], w[_JOINT + 2 * _4 + j]
    q4, q5, q6 = w[_JOINT + 3 * _4 + j], w[_JOINT + 5 * _4 + j], w[_JOINT + 7 * _4 + j]
    p4, p5, p6 = w[_JOINT + 4 * _4 + j], w[_JOINT + 6 * _4 + j], w[_JOINT + 8 * _4 + j]
    arm = q1 + q2 + q3 if w[_EXISTS + j] > 0.0 else np.nan
    whole, other = arm + q4 + q5 + q6, arm + p4 + p5 + p6  # NaN if one is
    w[OUT + j] = q1 if whole == whole else np.nan
    w[OUT + _4 + j] = q2 if whole == whole else np.nan
    w[OUT + 2 * _4 + j] = q3 if whole == whole else np.nan
    w[OUT + 3 * _4 + j] = q4 if whole == whole else np.nan
    w[OUT + 4 * _4 + j] = q5 if whole == whole else np.nan
    w[OUT + 5 * _4 + j] = q6 if whole == whole else np.nan
    w[OUT + 6 * _4 + j] = q1 if other == other else np.nan
    w[OUT + 7 * _4 + j] = q2 if other == other else np.nan
    w[OUT + 8 * _4 + j] = q3 if other == other else np.nan
    w[OUT + 9 * _4 + j] = p4 if other == other else np.nan
    w[OUT + 10 * _4 + j] = p5 if other == other else np.nan
    w[OUT + 11 * _4 + j] = p6 if other == other else np.nan


@inlined
def _sum(s, c, sine, cosine):
    """Sine and cosine of the sum of two angles."""
    return s * cosine + c * sine, c * cosine - s * sine


@inlined
def _undo_arm(geometry, s1, c1, s, c, v0, v1, v2):
    """Ry(-pitch) Rz(-q1) v, in the frame x4, y4, z4."""
    x, y = c1 * v0 + s1 * v1, c1 * v1 - s1 * v0
    turned = (c * x - s * v2, y, s * x + c * v2)
    x4, y4, z4 = geometry.wrist
    return (_dot(x4, turned), _dot(y4, turned), _dot(z4, turned))


@inlined
def _from_flange(geometry, w, i, vector):
    """A vector of the flange frame in the frame of the geometry."""
    f0, f1, f2 = vector
    return _from_base(
        geometry,
        w[POSE + i] * f0 + w[POSE + _1 + i] * f1 + w[POSE + 2 * _1 + i] * f2,
        w[POSE + 4 * _1 + i] * f0 + w[POSE + 5 * _1 + i] * f1 + w[POSE + 6 * _1 + i] * f2,
        w[POSE + 8 * _1 + i] * f0 + w[POSE + 9 * _1 + i] * f1 + w[POSE + 10 * _1 + i] * f2,
    )


@inlined
def _from_base(geometry, x, y, z):
    """A vector of the base frame in the frame of the geometry."""
    X, Y, Z = geometry.base
    v = (x, y, z)
    return (_dot(X, v), _dot(Y, v), _dot(Z, v))


@inlined
def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
