"""What happens between the seam points, where a controller interpolates the joints linearly."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from ..scene.certificate import reach
from ..scene.pairs import Pairs
from .cell import ROBOTS, WELDER, Cell
from .placement import Jobs
from .separation import WORKPIECE, Separation

_BUDGET = 200_000  # postures


class Bound(NamedTuple):
    """``lower`` <= smallest separation of the motion <= ``upper`` [m]."""

    lower: float
    upper: float


class Offset(NamedTuple):
    """What linear interpolation of the joints costs between the points.

    Attributes
    ----------
    step : float
        Largest turn of a joint from one point to the next [rad].
    seam : float
        Largest distance of the tip of the torch from the seam, of the workpiece as the carrier
        holds it that loses more [m].
    grips : float
        Largest distance of the places at which the two carriers hold one end of the main pipe [m].
    """

    step: float
    seam: float
    grips: float


class _Closed:
    """The first job as a closed motion over t in [0, N], linear in the joints; the workpiece turns
    about its origin by the smallest rotation from one point to the next."""

    def __init__(self, cell: Cell, jobs: Jobs) -> None:
        path = jobs.q[0].swapaxes(0, 1)
        turns = np.round((path[-1] - path[0]) / (2 * np.pi))
        self.q = np.concatenate([path, path[:1] + 2 * np.pi * turns])  # (N + 1, 3, 6)
        self.R = np.concatenate([cell.rotations, cell.rotations[:1]])
        self.turn = Rotation.from_matrix(self.R[:-1].transpose(0, 2, 1) @ self.R[1:]).as_rotvec()
        ways = [
            abs(np.diff(self.q, axis=0)).reshape(len(self.turn), -1),
            np.linalg.norm(self.turn, axis=1, keepdims=True),
        ]
        self.way = np.vstack([np.zeros(ways[0].shape[1] + 1), np.hstack(ways).cumsum(axis=0)])

    def at(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Joints (M, 3, 6), rotations of the workpiece (M, 3, 3), ways of all joints (M, 19)."""
        first = np.minimum(time.astype(int), len(self.turn) - 1)
        part = (time - first)[:, np.newaxis]
        way = self.way[first] + part * (self.way[first + 1] - self.way[first])
        q = self.q[first] + part[:, np.newaxis] * (self.q[first + 1] - self.q[first])
        turned = Rotation.from_rotvec(part * self.turn[first]).as_matrix()
        return q, self.R[first] @ turned, way


def certified_separation(
    cell: Cell, jobs: Jobs, tolerance: float = 1e-3, enough: float = np.inf
) -> Bound:
    """Bounds on the separation of the first job along the whole motion, not at its points alone.

    No point of a link moves further than the sum over its joints of |dq_j| times its greatest
    distance from axis j, and none of the workpiece further than its turn times its distance from
    the origin. Of a distance known at both ends of a piece of motion, along which the two bodies
    travel at most w, the smallest value is at least (d_0 + d_1 - w) / 2. Pieces are halved until
    that is good enough.

    Parameters
    ----------
    tolerance : float
        Wanted ``upper - lower`` [m].
    enough : float
        Pieces proved to keep this separation are not halved further [m].
    """
    separation, motion = Separation(cell), _Closed(cell, jobs)
    rates = _rates(cell, separation.pairs)

    def sample(time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        q, rotations, way = motion.at(time)
        centres = np.broadcast_to(jobs.centres[0], (len(time), 3))
        ends = separation.posed(q, rotations, centres)
        return time, separation.distances(ends), way @ rates.T

    every = sample(np.arange(cell.count + 1.0))
    start, end = tuple(part[:-1] for part in every), tuple(part[1:] for part in every)
    upper = lower = float(every[1].min())
    spent = cell.count
    while len(start[0]):
        bound = 0.5 * (start[1] + end[1] - (end[2] - start[2])).min(axis=1)
        unsure = bound < min(upper - tolerance, enough)
        if spent + unsure.sum() > _BUDGET:
            unsure[:] = False
        lower = min(lower, float(bound[~unsure].min(initial=np.inf)))
        start, end = tuple(part[unsure] for part in start), tuple(part[unsure] for part in end)
        middle = sample(0.5 * (start[0] + end[0]))
        spent += len(middle[0])
        upper = min(upper, float(middle[1].min(initial=np.inf)))
        start, end = (
            tuple(np.concatenate(both) for both in zip(start, middle, strict=True)),
            tuple(np.concatenate(both) for both in zip(middle, end, strict=True)),
        )
    return Bound(min(lower, upper), upper)


def interpolation_offset(cell: Cell, jobs: Jobs, seam: np.ndarray, parts: int = 8) -> Offset:
    """What the first job loses when the joints are interpolated linearly between its points.

    Parameters
    ----------
    seam : ndarray (M, 3)
        The seam in the frame of the workpiece, much denser than that of the cell [m].
    parts : int
        Places that are looked at between two points.
    """
    motion = _Closed(cell, jobs)
    q, _, _ = motion.at(np.arange(cell.count * parts) / parts)
    held = [_held(cell, k, q[:, k]) for k in range(WELDER)]
    flange, fixed = cell.bases[WELDER] @ cell.arms[WELDER].fk(q[:, WELDER]), cell.flanges[WELDER][0]
    lever = fixed[:3, :3].T @ cell.lever_arms[WELDER][0]
    tip = flange[:, :3, :3] @ lever + flange[:, :3, 3]
    local = [np.einsum("nji,nj->ni", T[:, :3, :3], tip - T[:, :3, 3]) for T in held]
    ends = [cell.pipe_axes[0] @ T[:, :3, :3].swapaxes(1, 2) + T[:, None, :3, 3] for T in held]
    return Offset(
        step=float(abs(np.diff(motion.q, axis=0)).max()),
        seam=float(cKDTree(seam).query(np.concatenate(local))[0].max()),
        grips=float(np.linalg.norm(ends[0] - ends[1], axis=2).max()),
    )


def _held(cell: Cell, robot: int, q: np.ndarray) -> np.ndarray:
    """Poses of the workpiece (M, 4, 4) as one carrier holds it at joints (M, 6) [m]."""
    grasp = cell.flanges[robot][0].copy()
    grasp[:3] = cell.rotations[0].T @ grasp[:3]
    return cell.bases[robot] @ cell.arms[robot].fk(q) @ np.linalg.inv(grasp)


def _rates(cell: Cell, pairs: Pairs) -> np.ndarray:
    """Greatest way of both bodies of a pair per way of every joint and of the workpiece (K, 19)."""
    levers = {name: reach(arm) for name, arm in zip(ROBOTS, cell.arms, strict=True)}
    extents = np.linalg.norm(cell.pipe_cores, axis=2).max(axis=1)
    rates = np.zeros((len(pairs), 19))
    for k, (a, b) in enumerate(pairs.bodies):
        if a.owner == b.owner:
            low, high = sorted((a, b), key=lambda body: body.joint or 0)
            column, joint = 6 * ROBOTS.index(a.owner), low.joint or 0
            rates[k, column + joint : column + 6] = levers[a.owner][high.link, joint:]
            continue
        for body in (a, b):
            if body.owner in levers:
                column = 6 * ROBOTS.index(body.owner)
                rates[k, column : column + 6] = levers[body.owner][body.link]
            elif body.owner == WORKPIECE:
                rates[k, 18] = extents[int(body.name.split("/")[1])]
    return rates
