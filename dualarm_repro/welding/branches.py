"""One branch of the inverse kinematics along a whole path of the flange, for many placements."""

from __future__ import annotations

import math
from enum import IntEnum

import numpy as np

from ..arms.wrist_ik import BRANCHES, inverse_kinematics
from ..copies import copy_row, copy_rows
from ..kernel import kernel
from .manipulability import manipulabilities

_TURN = 2.0 * math.pi
_QUARTER = 0.5 * math.pi
_PROBES = 6  # poses looked at first, to drop placements out of reach early


class Status(IntEnum):
    """Why a placement is not feasible; in the order in which the constraints are tested."""

    FEASIBLE = 0
    OUT_OF_REACH = 1
    JOINT_LIMITS = 2
    SINGULAR = 3
    COLLISION = 4


@kernel
def follow(geometry, base, flanges, centres, lower, upper, threshold):
    """Joint paths that carry the flange along its poses, for every placement of the path.

    Branches of the inverse kinematics meet only in singularities, so a path that avoids them stays
    on one branch. Each of the eight is continued along all poses without limits, its angles are
    unwrapped and each joint's path is shifted by one number of full turns into the limits. Of the
    branches that pass, the one with the largest mean manipulability is taken (of equal ones the
    first). The path is closed and its poses are samples of a smooth one: a branch whose wrist could
    leave the arm's reach between two of them does not pass, nor one that goes past a singularity
    there, which shows in a joint that turns by more than a quarter.

    Parameters
    ----------
    geometry : WristGeometry
    base : (4, 4)
        Pose of the base in the world.
    flanges : (N, 4, 4)
        Poses of the flange in the world for the placement 0 [m].
    centres : (P, 3)
        Displacements of the whole path [m].
    lower, upper : (6,)
        [rad]; infinite: no limits.
    threshold : float
        Manipulability [m^3] at or below which a configuration counts as singular; 0 admits paths
        that go past one between their poses.

    Returns
    -------
    q (P, N, 6), w (P, N), branch (P,), status (P,)
        NaN and -1 where no branch passes; the status is then that of the branch that came furthest.
    """
    count, poses = len(centres), len(flanges)
    q, w = np.full((count, poses, 6), np.nan), np.full((count, poses), np.nan)
    branch, status = np.full(count, -1), np.zeros(count, dtype=np.int64)
    free, middle = np.full(6, np.inf), np.zeros(6)
    for j in range(6):
        if np.isfinite(lower[j]) and np.isfinite(upper[j]):
            middle[j] = 0.5 * (lower[j] + upper[j])
    path, back = np.empty((poses, 6)), np.ascontiguousarray(base[:3, :3].T)
    local = np.empty((poses, 4, 4))
    origin = np.empty((poses, 3))
    for n in range(poses):
        copy_rows(flanges[n], local[n])
        copy_rows(back @ np.ascontiguousarray(flanges[n, :3, :3]), local[n, :3, :3])
        copy_row(back @ (flanges[n, :3, 3] - base[:3, 3]), origin[n])
    stride = max(1, poses // _PROBES)
    for p in range(count):
        centre = back @ centres[p]
        for n in range(poses):
            for r in range(3):
                local[n, r, 3] = origin[n, r] + centre[r]
        probes = inverse_kinematics(geometry, local[::stride].copy(), middle, -free, free)
        if not _any_branch(probes):
            status[p] = 1
            continue
        found = inverse_kinematics(geometry, local, middle, -free, free)
        best, furthest = -1.0, 1
        passed = -1
        for b in range(BRANCHES):
            # Branches 2k and 2k + 1 differ by a flip of the wrist and have equal measures.
            if b == passed + 1 and b % 2 == 1:
                continue
            copy_rows(found[:, b], path)
            if np.isnan(path).any() or not _reached_between(geometry, path):
                continue
            if not _within(path, lower, upper, middle):
                furthest = max(furthest, 2)
                continue
            measures = manipulabilities(geometry, path)
            if measures.min() <= threshold or (threshold > 0.0 and _jumps(path)):
                furthest = max(furthest, 3)
                continue
            furthest, passed = 4, b
            if measures.mean() > best:
                best = measures.mean()
                q[p], w[p], branch[p] = path, measures, b
        status[p] = 0 if best >= 0.0 else furthest
    return q, w, branch, status


@kernel
def _any_branch(found):
    """Whether some branch exists at every pose."""
    for b in range(BRANCHES):
        if not np.isnan(found[:, b, 0]).any():
            return True
    return False


@kernel
def _reached_between(geometry, path):
    """Whether the wrist stays within reach between the samples of a closed path.

    r^2 = l_2^2 + l_3^2 + 2 l_2 l_3 cos phi is the square of its distance from the shoulder. Between
    two samples a smooth function exceeds them by at most h^2 / 8 max |f''|, which is an eighth of
    its largest second difference.
    """
    upper, fore, count = geometry.upper_arm, geometry.forearm, len(path)
    r = np.empty(count)
    for n in range(count):
        pitch = path[n, 1] + geometry.elbow_sign * path[n, 2]
        s2, c2, s3, c3 = (
            math.sin(path[n, 1]),
            math.cos(path[n, 1]),
            math.sin(pitch),
            math.cos(pitch),
        )
        sine2, cosine2 = s2 * upper[2] + c2 * upper[1], c2 * upper[2] - s2 * upper[1]
        sine3, cosine3 = s3 * fore[2] + c3 * fore[1], c3 * fore[2] - s3 * fore[1]
        square = upper[0] ** 2 + fore[0] ** 2
        r[n] = math.sqrt(square + 2.0 * upper[0] * fore[0] * (cosine2 * cosine3 + sine2 * sine3))
    bend = 0.0
    for n in range(count):
        bend = max(bend, abs(r[n - 1] - 2.0 * r[n] + r[(n + 1) % count]))
    inner, outer = abs(upper[0] - fore[0]), upper[0] + fore[0]
    return min(outer - r.max(), r.min() - inner) >= 0.125 * bend


@kernel
def _jumps(path):
    """Whether a joint of a closed path, unwrapped, turns by more than pi/2 between two samples.

    Where the wrist's or the shoulder's axes align, two joints turn by pi at once. Seen from the
    nearest singular point two samples with more than pi/2 between them lie on different sides of
    it: linear interpolation of the joints would then follow another motion than the one meant.
    """
    for j in range(6):
        for n in range(len(path)):
            step = path[n, j] - path[n - 1, j]
            if n == 0:  # a joint may end turned by full turns
                step -= _TURN * np.round(step / _TURN)
            if abs(step) > _QUARTER:
                return True
    return False


@kernel
def _within(path, lower, upper, middle):
    """Unwrap a path in place, then shift every joint by full turns into its limits, if possible."""
    for j in range(6):
        smallest, largest = path[0, j], path[0, j]
        for n in range(1, len(path)):
            path[n, j] += _TURN * np.round((path[n - 1, j] - path[n, j]) / _TURN)
            smallest, largest = min(smallest, path[n, j]), max(largest, path[n, j])
        shift = _TURN * np.round((middle[j] - 0.5 * (smallest + largest)) / _TURN)
        if smallest + shift < lower[j] or largest + shift > upper[j]:
            return False
        path[:, j] += shift
    return True
