"""Certified bound on the clearance along a joint path, also between its samples.

No point of a link moves further than the sum over its joints of |dq_j| times its greatest possible
distance from the axis of joint j. A distance known at both ends of a piece of path along which the
two bodies can travel at most w relative to each other is therefore nowhere below
(d_0 + d_1 - w) / 2. Pieces are halved until that bound is good enough.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import INFINITE, Count, Positive, checked
from ..arms.arm import Arm
from ..arms.exclusions import shape_of
from ..arms.fit.triangles import PRISM
from .clearance import distances
from .hull import ConvexHull
from .hull_pairs import hull_pairs
from .moving import JointPath, MovingArm
from .posing import links_of
from .quantities import positive
from .scene import Scene
from .shape_pairs import shape_pairs
from .shapes import Box, Capsule, Sphere


class Bracket(NamedTuple):
    """``lower`` <= smallest clearance along the path <= ``upper`` [m].

    ``upper`` is attained at configuration ``q`` and time ``time``; ``evaluations`` configurations
    were computed.
    """

    lower: float
    upper: float
    q: np.ndarray
    time: float
    evaluations: int


@checked
def certified_minimum(
    scene: Scene,
    path: ArrayLike,
    index: ArrayLike | None = None,
    tolerance: Positive = 1e-3,
    enough: Annotated[float, INFINITE] = np.inf,
    budget: Count = 200_000,
) -> Bracket:
    """Bounds on min over s of min over pairs of d(q(s), t(s)) for a path linear between samples.

    Parameters
    ----------
    path : (M, nq)
        Configurations of the controlled arms [rad].
    index : (M,), optional
        Time of each sample for moving obstacles; 0 ... M-1 if not given.
    tolerance : float
        Wanted ``upper - lower`` [m].
    enough : float
        Pieces proved to keep this clearance are not refined; 0 proves freedom of contact at the
        least cost.
    budget : int
        Most configurations to compute; if that is not enough the bracket stays wider, yet true.

    Raises
    ------
    ConfigurationError, InputError
        A path or index of wrong form, a tolerance that is not positive.
    """
    scene.configurations(path)
    track = JointPath(path, index)
    positive("certified_minimum", "tolerance", tolerance)

    def measured(q: np.ndarray, time: np.ndarray) -> np.ndarray:
        return distances(scene, q, time)

    walked = _travel(scene, track)
    return bracketed(track, measured, walked, track.index, tolerance, enough, budget)


def bracketed(
    track: JointPath,
    measured: Callable[[np.ndarray, np.ndarray], np.ndarray],
    walked: Callable[[np.ndarray], np.ndarray],
    looks: np.ndarray,
    tolerance: float,
    enough: float,
    budget: int,
) -> Bracket:
    """Bounds on the smallest of some distances along a path, halving its pieces where needed.

    Parameters
    ----------
    measured : callable
        Configurations (N, nq) and times (N,) -> distances (N, P) [m].
    walked : callable
        Times (N,) -> ways (N, P) that the two of each pair have moved relative to each other at
        most since the first [m].
    looks : (M,)
        Times to begin with, the first and the last of the path among them.
    tolerance, enough, budget
        As in :func:`certified_minimum`.
    """

    def sample(time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return time, measured(track.at(time), time), walked(time)

    time, distance, travel = sample(looks)
    best, best_time = _smallest(distance, time)
    evaluations, lower = len(time), best
    start = tuple(part[:-1] for part in (time, distance, travel))
    end = tuple(part[1:] for part in (time, distance, travel))
    while len(start[0]):
        bound = (0.5 * (start[1] + end[1] - (end[2] - start[2]))).min(axis=1, initial=np.inf)
        unsure = bound < min(best - tolerance, enough)
        if evaluations + unsure.sum() > budget:
            unsure[:] = False
        lower = min(lower, bound[~unsure].min(initial=np.inf))
        start, end = tuple(part[unsure] for part in start), tuple(part[unsure] for part in end)
        middle = sample(0.5 * (start[0] + end[0]))
        evaluations += len(middle[0])
        candidate, candidate_time = _smallest(middle[1], middle[0])
        if candidate < best:
            best, best_time = candidate, candidate_time
        start, end = (
            tuple(np.concatenate(both) for both in zip(start, middle, strict=True)),
            tuple(np.concatenate(both) for both in zip(middle, end, strict=True)),
        )
    q = track.at(np.array([best_time]))[0]
    return Bracket(float(min(lower, best)), best, q, best_time, evaluations)


def _smallest(distance: np.ndarray, time: np.ndarray) -> tuple[float, float]:
    if distance.size == 0:
        return np.inf, float(time[0]) if len(time) else np.nan
    least = distance.min(axis=1)
    return float(least.min()), float(time[least.argmin()])


def reach(arm: Arm, slide: np.ndarray | None = None) -> np.ndarray:
    """Greatest distance of any core point of each capsule from the axis of each joint, (C, nq) [m].

    Distance of the next joint's origin from the axis, plus the lengths of the further offsets, plus
    that of the core's end, plus the largest ``slide`` of each joint between; 0 for the joints that
    do not move the capsule. All points move as far as a prismatic joint does: 1.

    Parameters
    ----------
    slide : (nq,), needed for an arm with prismatic joints
        Largest |q| of them along the path [m]; of others not read.
    """
    offset, links, slides = arm.motion.translation, links_of(arm), arm.slides
    slide = np.zeros(arm.nq) if slide is None else np.where(slides, slide, 0.0)
    bound = np.zeros((len(links.joint), arm.nq))
    for row, joint, ends in zip(bound, links.joint, links.local, strict=True):
        for j in range(1, joint + 1):
            if slides[j - 1]:
                row[j - 1] = 1.0
                continue
            for end in ends:
                first, *further = [*offset[j:joint], end]
                length = np.hypot(*first[:2]) + sum(np.linalg.norm(part) for part in further)
                row[j - 1] = max(row[j - 1], length + slide[j:joint].sum())
    return bound


def _travel(scene: Scene, track: JointPath) -> Callable[[np.ndarray], np.ndarray]:
    """Bound on the way the bodies of each pair have moved relative to each other, t -> (N, P)."""
    slide = np.abs(track.configurations).max(axis=0)
    lever = {
        placed.name: reach(placed.arm, slide[scene.columns[placed.name]]) for placed in scene.arms
    }
    for name, mover in scene.moving.items():
        if isinstance(mover, MovingArm):
            lever[name] = reach(mover.arm, np.abs(mover.path.configurations).max(axis=0))
        else:
            lever[name] = np.array([[1.0, _extent(mover.shape)]])
    wide = {placed.name: _wide(placed.arm, lever[placed.name]) for placed in scene.arms}
    hulled = {pair.column for pairs in hull_pairs(scene).values() for pair in pairs}
    shaped = {k for pairs in shape_pairs(scene).values() for pair in pairs for k in pair.columns}
    rate = {name: np.zeros((len(scene.pairs), table.shape[1])) for name, table in lever.items()}
    for k, (a, b) in enumerate(scene.pairs.bodies):
        if a.owner == b.owner:
            low, high = sorted((a, b), key=lambda body: body.joint or 0)
            moved = slice(low.joint, high.joint)
            rate[a.owner][k, moved] = lever[a.owner][high.link, moved]
            if k in shaped:
                rate[a.owner][k, moved] = wide[a.owner].shape[high.link, moved]
            elif k in hulled:
                rate[a.owner][k, moved] = wide[a.owner].hull[high.link, moved]
        else:
            for body in (a, b):
                if body.owner in rate:
                    rate[body.owner][k] = lever[body.owner][body.link]
    controlled = np.hstack([rate.pop(placed.name) for placed in scene.arms])
    terms = [(track, controlled), *((scene.moving[name].path, rate[name]) for name in rate)]
    return lambda time: sum(path.travel(time) @ rate.T for path, rate in terms)


class _Wide(NamedTuple):
    """Levers (C, nq) of all points of the hull in each capsule, and of those of its whole shape."""

    hull: np.ndarray
    shape: np.ndarray


def _wide(arm: Arm, lever: np.ndarray) -> _Wide:
    """Corners of a hull are farther from an axis than the core of its capsule by its radius, those
    of a prism around a rod by a little more; a shape is in all capsules that have its name."""
    links = links_of(arm)
    grown = lever + np.where((lever > 0.0) & ~arm.slides, PRISM * links.radius[:, np.newaxis], 0.0)
    names = np.array([shape_of(name) for name in links.names])
    whole = [grown[names == name].max(axis=0) for name in names]
    return _Wide(grown, np.array(whole).reshape(grown.shape))


def _extent(shape: Sphere | Capsule | Box | ConvexHull) -> float:
    """Distance of the farthest point of a shape's core from the origin of its frame."""
    match shape:
        case Box():
            return float(np.linalg.norm(shape.center) + np.linalg.norm(shape.half))
        case ConvexHull():
            return float(np.linalg.norm(shape.vertices, axis=1).max())
        case _:
            return float(np.linalg.norm(shape.core, axis=1).max())
