"""Constants of six revolute joints with a spherical wrist, derived from their axes at q = 0."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..errors import UnsupportedArmError
from .kernels import Chain


class WristGeometry(NamedTuple):
    """Constants of the arm at q = 0 in the frame with Z along axis 1 and Y along axis 2."""

    base: np.ndarray  # (3, 3) rotation of that frame in the base frame
    origin: np.ndarray  # (3,) its origin, on axis 1
    shoulder: np.ndarray  # (2,) X and Z of axis 2
    lateral: float  # Y of the wrist centre
    upper_arm: np.ndarray  # (3,) length, sine and cosine of its angle from Z to X
    forearm: np.ndarray  # (3,) the same
    elbow_sign: float  # axis 3 along +Y or -Y
    wrist: np.ndarray  # (4, 3) rows z4, z5, z6 and a unit normal of z6
    flange: np.ndarray  # (3, 3) in its own frame: z6, that normal, flange minus wrist centre


def wrist_geometry(name: str, chain: Chain) -> WristGeometry:
    """Derive the constants from the chain.

    Raises
    ------
    UnsupportedArmError
        Not six joints, axis 1 not perpendicular to axis 2, axis 2 not parallel to axis 3, the last
        three axes do not meet in one point, or a link has no length.
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
        np.array([length, *(link / length)]) for length, link in zip(lengths, links, strict=True)
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
