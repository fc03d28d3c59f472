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
BOUNDARY = 1e-12  # relative overshoot of a cosine that rounding is allowed
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
    axes: np.ndarray  # (3, 3) rows z4, z5, z6
    flange: np.ndarray  # (3, 3) rows: in the flange frame, z6, a normal of z6, flange minus wrist centre


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
        axes=np.array([z4, z5, z6]) @ base,
        flange=np.array([z6, normal, origins[6] - centre]) @ pose,
    )


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
def _row(matrix, k):
    return (matrix[k, 0], matrix[k, 1], matrix[k, 2])


@njit(cache=True)
def _apply_transposed(matrix, v):
    return (
        matrix[0, 0] * v[0] + matrix[1, 0] * v[1] + matrix[2, 0] * v[2],
        matrix[0, 1] * v[0] + matrix[1, 1] * v[1] + matrix[2, 1] * v[2],
        matrix[0, 2] * v[0] + matrix[1, 2] * v[1] + matrix[2, 2] * v[2],
    )


@njit(cache=True)
def _in_arm_frame(geometry, pose, k):
    """A vector given in the flange frame (row ``k`` of ``flange``), in the frame of the geometry."""
    f = _row(geometry.flange, k)
    v = (_dot(_row(pose, 0), f), _dot(_row(pose, 1), f), _dot(_row(pose, 2), f))
    return _apply_transposed(geometry.base, v)


@njit(cache=True)
def _wrist_angles(geometry, tool, normal, branch, reference):
    """q4, q5, q6 with N z6 = ``tool`` and N n = ``normal``; valid is false if q5 does not exist."""
    z4, z5, z6 = _row(geometry.axes, 0), _row(geometry.axes, 1), _row(geometry.axes, 2)
    a, b, c = _dot(z4, z5), _dot(z5, z6), _dot(z4, tool)
    zero = math.atan2(_dot(z4, _cross(z5, z6)), _dot(z4, z6) - a * b)
    across = _cross(z4, tool)
    square = _dot(across, across) - a * a - b * b + 2.0 * a * b * c
    valid = square > -BOUNDARY
    sine = math.sqrt(max(square, 0.0))
    q5 = zero + math.atan2(-sine if branch & 1 else sine, c - a * b)
    s5, c5 = math.sin(q5), math.cos(q5)
    bent = _turn(z5, s5, c5, z6)
    side = _cross(z4, bent)
    if _dot(side, side) < SINGULAR * SINGULAR:
        q4 = reference[3]
    else:
        q4 = math.atan2(_dot(side, tool), _dot(bent, tool) - _dot(z4, bent) * c)
    s4, c4 = math.sin(q4), math.cos(q4)
    n = _cross(geometry.flange_normal, z6)
    return valid, q4, q5, 0.0
