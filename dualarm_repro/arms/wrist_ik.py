"""Closed-form inverse kinematics of six revolute joints with a spherical wrist.

The wrist centre W = p - R d depends on q1, q2, q3 only: axis 1 turns the vertical plane of the arm, in
which upper arm and forearm form a planar 2R chain; then the product of exponentials of the wrist,
exp(z4 q4) exp(z5 q5) exp(z6 q6) = N, is solved for its three angles (D. L. Pieper, 1968; B. Paden, 1986).
Two signs at shoulder, elbow and wrist give the eight branches.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit

from ..errors import UnsupportedArmError
from .kernels import Chain

BRANCHES = 8  # index 4 (shoulder back) + 2 (elbow negative) + (wrist negative)
SINGULAR = 1e-11  # sine below which an angle is undetermined and its reference is taken
BOUNDARY = 1e-12  # relative overshoot of a square that rounding is allowed
ON_LIMIT = 1e-11  # overshoot of a joint limit [rad] that is clipped
_TIE = 1e-9  # half turns away from the reference are taken on the upper side within this
_TURN = 2.0 * math.pi


class WristGeometry(NamedTuple):
    """Constants of the arm at q = 0 in the frame with Z along axis 1 and Y along axis 2."""

    base: np.ndarray  # (3, 3) rotation of that frame in the base frame
    origin: np.ndarray  # (3,) its origin, on axis 1
    shoulder: np.ndarray  # (2,) X and Z of axis 2
    lateral: float  # Y of the wrist centre
    upper_arm: np.ndarray  # (2,) length, angle from Z to X
    forearm: np.ndarray  # (2,) length, angle from Z to X
    elbow_sign: float  # axis 3 along +Y or -Y
    wrist: np.ndarray  # (4, 3) rows z4, z5, z6 and a unit normal of z6
    flange: np.ndarray  # (3, 3) in the flange frame, rows z6, that normal, flange minus wrist centre


def wrist_geometry(name: str, chain: Chain) -> WristGeometry:
    """Derive the constants from the chain.

    Raises
    ------
    UnsupportedArmError
        Not six joints, axis 1 not perpendicular to axis 2, axis 2 not parallel to axis 3, the last three
        axes do not meet in one point, or a link has no length.
    """

    def require(condition: bool, what: str) -> None:
        if not condition:
            raise UnsupportedArmError(f"arm {name}: closed-form inverse kinematics needs {what}")

    require(len(chain.rotation) == 7, "six joints")
    origins, axes, pose, point = [], [], np.eye(3), np.zeros(3)
    for rotation, translation in zip(chain.rotation, chain.translation, strict=True):
        point, pose = point + pose @ translation, pose @ rotation
        origins.append(point)
        axes.append(pose[:, 2])
    require(abs(axes[0] @ axes[1]) < 1e-9, "axis 1 perpendicular to axis 2")
    require(np.linalg.norm(np.cross(axes[1], axes[2])) < 1e-9, "axis 2 parallel to axis 3")
    z4, z5, z6 = axes[3:6]
    crossing = min(np.linalg.norm(np.cross(z4, z5)), np.linalg.norm(np.cross(z5, z6)))
    require(crossing > 1e-6, "axis 5 not parallel to axes 4 and 6")
    along, *_ = np.linalg.lstsq(np.column_stack([z4, -z5]), origins[4] - origins[3], rcond=None)
    centre = origins[3] + along[0] * z4
    gaps = [np.linalg.norm(np.cross(centre - origins[k], axes[k])) for k in (3, 4, 5)]
    require(max(gaps) < 1e-9, "the axes 4, 5, 6 to meet in one point")

    base = np.column_stack([np.cross(axes[1], axes[0]), axes[1], axes[0]])
    shoulder, elbow, wrist = (base.T @ (x - origins[0]) for x in (origins[1], origins[2], centre))
    links = [(elbow - shoulder)[[0, 2]], (wrist - elbow)[[0, 2]]]
    lengths = [math.hypot(*link) for link in links]
    require(min(lengths) > 1e-9, "an upper arm and a forearm of some length")
    normal = np.cross(z6, np.eye(3)[np.argmin(abs(z6))])
    normal /= np.linalg.norm(normal)
    upper_arm, forearm = (
        np.array([length, math.atan2(*link)]) for length, link in zip(lengths, links, strict=True)
    )
    return WristGeometry(
        base=base,
        origin=origins[0],
        shoulder=shoulder[[0, 2]],
        lateral=float(wrist[1]),
        upper_arm=upper_arm,
        forearm=forearm,
        elbow_sign=math.copysign(1.0, axes[1] @ axes[2]),
        wrist=np.array([z4, z5, z6, normal]) @ base,
        flange=np.array([z6, normal, origins[6] - centre]) @ pose,
    )


@njit(cache=True)
def inverse_kinematics(geometry, poses, reference, lower, upper):
    """All branches for every flange pose.

    Parameters
    ----------
    geometry : WristGeometry
    poses : ndarray (N, 4, 4)
    reference : ndarray (6,)
        Angles [rad]: each joint is the representative nearest to it, and equals it where undetermined
        (q1 with the wrist centre on axis 1, q2 with it on axis 2, q4 with aligned axes 4 and 6).
    lower, upper : ndarray (6,)
        Limits [rad]; infinite ones allow every angle.

    Returns
    -------
    ndarray (N, 8, 6)
        NaN where a branch does not exist or has no representative within the limits.
    """
    out = np.empty((len(poses), BRANCHES, 6))
    for k in range(len(poses)):
        pose = poses[k]
        d = _in_arm_frame(geometry, pose, 2)
        p = _to_arm(geometry, pose[:3, 3] - geometry.origin)
        centre = (p[0] - d[0], p[1] - d[1], p[2] - d[2])
        tool, normal = _in_arm_frame(geometry, pose, 0), _in_arm_frame(geometry, pose, 1)
        for arm in range(4):
            s1, c1, s, c, reached = _arm_angles(geometry, centre, arm, reference, out[k, 2 * arm])
            out[k, 2 * arm + 1, :3] = out[k, 2 * arm, :3]
            near, level = _undo_arm(s1, c1, s, c, tool), _undo_arm(s1, c1, s, c, normal)
            for branch in range(2 * arm, 2 * arm + 2):
                q = out[k, branch]
                if not (
                    reached
                    and _wrist_angles(geometry, near, level, branch, reference, q)
                    and _bring_within(q, reference, lower, upper)
                ):
                    q[:] = np.nan
    return out


@njit(cache=True)
def _arm_angles(geometry, centre, arm, reference, q):
    """q1, q2, q3 that put the wrist centre there; sine and cosine of q1 and of the pitch q2 +- q3."""
    l2, l3 = geometry.upper_arm[0], geometry.forearm[0]
    slack = BOUNDARY * (l2 + l3) ** 2
    b = geometry.lateral
    square = centre[0] ** 2 + centre[1] ** 2
    radius = math.sqrt(max(square - b * b, 0.0))
    if arm & 2:
        radius = -radius
    if square > slack * SINGULAR:
        s1 = (centre[1] * radius - centre[0] * b) / square
        c1 = (centre[0] * radius + centre[1] * b) / square
        q[0] = math.atan2(s1, c1)
    else:
        q[0] = reference[0]
        s1, c1 = math.sin(q[0]), math.cos(q[0])

    x, z = radius - geometry.shoulder[0], centre[2] - geometry.shoulder[1]
    distance = math.hypot(x, z)
    unbent = (l2 + l3 - distance) * (l2 + l3 + distance)
    folded = (distance - l2 + l3) * (distance + l2 - l3)
    reached = square > b * b - slack and unbent > -slack and folded > -slack
    sine = math.sqrt(max(unbent, 0.0) * max(folded, 0.0)) / (2.0 * l2 * l3)
    if arm & 1:
        sine = -sine
    cosine = (folded - unbent) / (4.0 * l2 * l3)
    bend = math.atan2(sine, cosine)
    if distance * distance > slack * SINGULAR:
        ahead, behind = l2 + l3 * cosine, l3 * sine
        upper_arm = math.atan2(x * ahead - z * behind, z * ahead + x * behind)
    else:
        upper_arm = reference[1] + geometry.upper_arm[1]
    q[1] = upper_arm - geometry.upper_arm[1]
    q[2] = geometry.elbow_sign * (bend + geometry.upper_arm[1] - geometry.forearm[1])
    pitch = upper_arm + bend - geometry.forearm[1]
    return s1, c1, math.sin(pitch), math.cos(pitch), reached


@njit(cache=True)
def _wrist_angles(geometry, tool, normal, branch, reference, q):
    """q4, q5, q6 that turn z6 into ``tool`` and its normal into ``normal``; false if q5 is not real."""
    z4, z5, z6 = _row(geometry.wrist, 0), _row(geometry.wrist, 1), _row(geometry.wrist, 2)
    skew4, skew6, along = _dot(z4, z5), _dot(z5, z6), _dot(z4, tool)
    across = _cross(z4, tool)
    square = _dot(across, across) - skew4**2 - skew6**2 + 2.0 * skew4 * skew6 * along
    if square < -BOUNDARY:
        return False
    sine, cosine = math.sqrt(max(square, 0.0)), along - skew4 * skew6
    if branch & 1:
        sine = -sine
    sine0, cosine0 = _dot(z4, _cross(z5, z6)), _dot(z4, z6) - skew4 * skew6
    scale = sine0**2 + cosine0**2
    s5, c5 = (cosine * sine0 + sine * cosine0) / scale, (cosine * cosine0 - sine * sine0) / scale
    q[4] = math.atan2(s5, c5)

    bent = _turn(z5, s5, c5, z6)
    side = _cross(z4, bent)
    square = _dot(side, side)
    if square > SINGULAR**2:
        s4 = _dot(side, tool) / square
        c4 = (_dot(bent, tool) - _dot(z4, bent) * along) / square
        q[3] = math.atan2(s4, c4)
    else:
        q[3] = reference[3]
        s4, c4 = math.sin(q[3]), math.cos(q[3])

    rest = _row(geometry.wrist, 3)
    cosine = _dot(normal, _turn(z4, s4, c4, _turn(z5, s5, c5, rest)))
    sine = _dot(normal, _turn(z4, s4, c4, _turn(z5, s5, c5, _cross(z6, rest))))
    q[5] = math.atan2(sine, cosine)
    return True


@njit(cache=True)
def _bring_within(q, reference, lower, upper):
    """Shift every angle by full turns next to its reference, then into its limits if they allow it."""
    for j in range(6):
        angle = q[j] + _TURN * math.floor((reference[j] - q[j]) / _TURN + 0.5 + _TIE)
        while angle > upper[j] + ON_LIMIT:
            angle -= _TURN
        while angle < lower[j] - ON_LIMIT:
            angle += _TURN
        if angle > upper[j] + ON_LIMIT:
            return False
        q[j] = min(max(angle, lower[j]), upper[j])
    return True


@njit(cache=True)
def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit(cache=True)
def _cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@njit(cache=True)
def _turn(axis, s, c, v):
    """exp(axis angle) v, with the sine and cosine of the angle."""
    k = _dot(axis, v) * (1.0 - c)
    x = _cross(axis, v)
    return (
        v[0] * c + x[0] * s + axis[0] * k,
        v[1] * c + x[1] * s + axis[1] * k,
        v[2] * c + x[2] * s + axis[2] * k,
    )


@njit(cache=True)
def _undo_arm(s1, c1, s, c, v):
    """Ry(-pitch) Rz(-q1) v."""
    x, y = c1 * v[0] + s1 * v[1], c1 * v[1] - s1 * v[0]
    return (c * x - s * v[2], y, s * x + c * v[2])


@njit(cache=True)
def _row(matrix, k):
    return (matrix[k, 0], matrix[k, 1], matrix[k, 2])


@njit(cache=True)
def _to_arm(geometry, v):
    """A vector of the base frame in the frame of the geometry."""
    base = geometry.base
    return (
        base[0, 0] * v[0] + base[1, 0] * v[1] + base[2, 0] * v[2],
        base[0, 1] * v[0] + base[1, 1] * v[1] + base[2, 1] * v[2],
        base[0, 2] * v[0] + base[1, 2] * v[1] + base[2, 2] * v[2],
    )


@njit(cache=True)
def _in_arm_frame(geometry, pose, k):
    """Row ``k`` of ``geometry.flange``, a vector of the flange frame, in the frame of the geometry."""
    f = _row(geometry.flange, k)
    return _to_arm(geometry, (_dot(pose[0], f), _dot(pose[1], f), _dot(pose[2], f)))
