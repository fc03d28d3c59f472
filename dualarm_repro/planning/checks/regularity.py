"""How near the postures of a path come to singular ones, and what a straight line needs of them."""

from __future__ import annotations

from enum import StrEnum

import numpy as np
import pinocchio as pin
import scipy
from numpy.typing import ArrayLike

from ...arms import Arm

_SAMPLES = 200  # of a straight line
_JUMP = 0.5  # of a joint between two of them that is no motion any more [rad]
_ROUND_OFF = 1e-9  # of the largest determinant on a path


class Line(StrEnum):
    """How inverse kinematics followed a straight line of the flange."""

    FOLLOWED = "followed"
    JUMP = "jump"
    STRETCHED = "beyond the straight arm"


def least_singular_value(arm: Arm, path: np.ndarray) -> float:
    """Smallest singular value of the position Jacobian on a path (N, nq) [m/rad]."""
    return float(np.linalg.svd(arm.jacobian(path)[:, :3], compute_uv=False)[:, -1].min())


def crosses_singularity(arm: Arm, path: np.ndarray) -> bool:
    """Whether det J of six joints changes its sign on a path (N, 6), so that one posture in
    between is singular; det J below round-off has no sign."""
    det = np.linalg.det(arm.jacobian(path))
    seen = np.sign(det[np.abs(det) > _ROUND_OFF * np.abs(det).max()])
    return bool((seen[1:] != seen[:-1]).any())


def follow_line(arm: Arm, start: ArrayLike, goal: ArrayLike) -> Line:
    """Follow the straight line of the flange between two postures (6,), turning evenly, by inverse
    kinematics.

    Joint limits are not looked at: the line ends beyond the straight arm, or where the nearest
    posture is a jump away, which between two samples so close takes a posture that is nearly
    singular.

    Raises
    ------
    UnsupportedArmError
        The arm has no closed form.
    """
    ends = [pin.SE3(arm.fk(np.asarray(q, dtype=float))) for q in (start, goal)]
    shares = np.linspace(0.0, 1.0, _SAMPLES + 1)[1:]
    turn = pin.log3(ends[0].rotation.T @ ends[1].rotation)
    poses = np.tile(np.eye(4), (_SAMPLES, 1, 1))
    turns = scipy.spatial.transform.Rotation.from_rotvec(shares[:, np.newaxis] * turn).as_matrix()
    poses[:, :3, :3] = ends[0].rotation @ turns
    way = ends[1].translation - ends[0].translation
    poses[:, :3, 3] = ends[0].translation + shares[:, np.newaxis] * way
    q = np.asarray(start, dtype=float)
    for branches in arm.ik_branches(poses, reference=q, within_limits=False):
        there = branches[np.isfinite(branches).all(axis=1)]
        if not len(there):
            return Line.STRETCHED
        change = (there - q + np.pi) % (2.0 * np.pi) - np.pi
        nearest = int(np.abs(change).max(axis=1).argmin())
        if np.abs(change[nearest]).max() > _JUMP:
            return Line.JUMP
        q = q + change[nearest]
    return Line.FOLLOWED
