"""Constants of six revolute joints with a spherical wrist, derived from their axes at q = 0."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..arguments import checked
from ..errors import UnsupportedArmError
from .chain import Chain

Vector = tuple[float, float, float]


class WristGeometry(NamedTuple):
    """Constants of the arm at q = 0 in the frame with Z along axis 1 and Y along axis 2.

    Plain tuples, so that compiled code keeps them in registers.
    """

    base: tuple[Vector, Vector, Vector]  # rows X, Y, Z of that frame in the base frame
    origin: Vector  # its origin, on axis 1
    shoulder: tuple[float, float]  # X and Z of axis 2
    lateral: float  # Y of the wrist centre
    upper_arm: Vector  # length, sine and cosine of its angle from Z to X
    forearm: Vector  # the same
    elbow_sign: float  # axis 3 along +Y or -Y
    wrist: tuple[Vector, Vector, Vector]  # rows x4, y4, z4 with x4 along z4 x z5
    twists: tuple[tuple[float, float], tuple[float, float]]  # sines, cosines: z4 to z5, z5 to z6
    turn: tuple[float, float]  # sine and cosine of the angle from x4 to x5 = z5 x z6 about z5
    flange: tuple[Vector, Vector, Vector]  # in its own frame: z6, x5, flange minus wrist centre


@checked
def wrist_geometry(name: str, chain: Chain) -> WristGeometry:
    """Derive the constants from the chain.

    Raises
    ------
    UnsupportedArmError
        Not six joints, axis 1 not perpendicular to axis 2, axis 2 not parallel to axis 3, the last
        three axes do not meet in one point, or a link has no length.
    """

    def require(condition: bool | np.bool, what: str) -> None:
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
    x4, x5 = np.cross(z4, z5), np.cross(z5, z6)
    twists = np.array([[math.hypot(*x4), z4 @ z5], [math.hypot(*x5), z5 @ z6]])
    require(twists[:, 0].min() > 1e-6, "axis 5 not parallel to axes 4 and 6")
    x4, x5 = x4 / twists[0, 0], x5 / twists[1, 0]
    along, *_ = np.linalg.lstsq(np.column_stack([z4, -z5]), origins[4] - origins[3], rcond=None)
    centre = origins[3] + along[0] * z4
    gaps = [np.linalg.norm(np.cross(centre - origins[k], axes[k])) for k in (3, 4, 5)]
    require(max(gaps) < 1e-9, "the axes 4, 5, 6 to meet in one point")

    base = np.array([np.cross(axes[1], axes[0]), axes[1], axes[0]])
    shoulder, elbow, wrist = (base @ (x - origins[0]) for x in (origins[1], origins[2], centre))
    links = [(elbow - shoulder)[[0, 2]], (wrist - elbow)[[0, 2]]]
    lengths = [math.hypot(*link) for link in links]
    require(min(lengths) > 1e-9, "an upper arm and a forearm of some length")
    upper_arm, forearm = (
        (length, *_plain(link / length)) for length, link in zip(lengths, links, strict=True)
    )
    return WristGeometry(
        base=_plain(base),
        origin=_plain(origins[0]),
        shoulder=_plain(shoulder[[0, 2]]),
        lateral=float(wrist[1]),
        upper_arm=upper_arm,
        forearm=forearm,
        elbow_sign=math.copysign(1.0, axes[1] @ axes[2]),
        wrist=_plain(np.array([x4, np.cross(z4, x4), z4]) @ base.T),
        twists=_plain(twists),
        turn=(float(z5 @ np.cross(x4, x5)), float(x4 @ x5)),
        flange=_plain(np.array([z6, x5, origins[6] - centre]) @ pose),
    )


def _plain(array: np.ndarray) -> tuple:
    """The array as nested tuples of Python floats."""
    return tuple(map(_plain, array)) if array.ndim > 1 else tuple(array.tolist())
