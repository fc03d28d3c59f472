"""The fastest timing of a path of all arms that keeps their limits, from rest to rest.

max over s'(s) under |q'(s) s'| <= v and |q''(s) s'^2 + q'(s) s''| <= a, by reachability analysis on
a grid: H. Pham and Q.-C. Pham, A new approach to time-optimal path parameterization based on
reachability analysis, IEEE Trans. Robotics 34(3), 2018 (toppra). The path becomes a cubic spline
through its rows, which leaves the polygon between them by a little: what is timed has to be judged
again, and says how far it is away.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...errors import InputError
from ...quiet_import import quietly
from ...scene import JointPath, Scene, densify
from ..field.control_points import end_effector

#: Rows of a path are no further apart than this before the spline goes through them [rad].
SPACING = 0.02
#: Most samples of a timed motion: half an hour at a hundred a second.
MOST_SAMPLES = 200_000
#: Steps shorter than this are one row [rad].
_SAME = 1e-9
#: Grid of the reachability analysis.
_GRID = 400


@dataclass(frozen=True, eq=False)
class TimedMotion:
    """A motion of all arms of a scene.

    Attributes
    ----------
    time : ndarray (T,)
        [s]
    q, speed, acceleration : ndarray (T, nq)
        Of the arms one after the other [rad], [rad/s], [rad/s^2].
    deviation : float
        Largest distance of a sample from the path that was to be timed, largest joint [rad].
    """

    scene: Scene
    time: np.ndarray
    q: np.ndarray
    speed: np.ndarray
    acceleration: np.ndarray
    deviation: float

    @property
    def duration(self) -> float:
        """[s]"""
        return float(self.time[-1])

    @property
    def paths(self) -> dict[str, JointPath]:
        """Of every arm over the time, to be judged."""
        columns = self.scene.columns.items()
        return {name: JointPath(self.q[:, part], self.time) for name, part in columns}

    def tips(self) -> dict[str, np.ndarray]:
        """Flange of every arm in the world (T, 3) [m]."""
        columns = self.scene.columns
        return {
            one.name: end_effector(one, self.q[:, columns[one.name]]) for one in self.scene.arms
        }


def timed(
    scene: Scene,
    paths: Mapping[str, JointPath],
    *,
    speed: float = 1.0,
    acceleration: float = 5.0,
    rate: float = 100.0,
) -> TimedMotion:
    """Time the motion of all arms together; they keep to each other's progress along it.

    Parameters
    ----------
    paths : mapping of arm to path
        Of every arm of the scene, over a common index.
    speed : float
        Share of the speed limits of the joints that may be used, above 0 and up to 1.
    acceleration : float
        Largest acceleration of any joint [rad/s^2].
    rate : float
        Samples a second.

    Raises
    ------
    InputError
        A limit that is not positive, obstacles that move by themselves, a path that rests or that
        cannot be timed, or more samples than :data:`MOST_SAMPLES`.
    """
    for name, value in (("speed", speed), ("acceleration", acceleration), ("rate", rate)):
        if not (np.isfinite(value) and value > 0):
            raise InputError("timing", name, value, "a positive number")
    if speed > 1.0:
        raise InputError("timing", "speed", speed, "a share of the speed limits, at most 1")
    if moving := [n for n, one in scene.moving.items() if len(one.path.index) > 1]:
        expected = "a scene in which only the arms move: at another time they are elsewhere"
        raise InputError("timing", "moving", moving[0], expected)
    polygon = _polygon(scene, paths)
    length = np.abs(np.diff(polygon, axis=0)).max(axis=1)
    polygon = polygon[np.concatenate([[True], length > _SAME])]
    if len(polygon) < 2:
        raise InputError("timing", "path", len(polygon), "a path along which an arm moves")
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(polygon, axis=0), axis=1))])
    fastest = speed * np.concatenate([one.arm.velocity_limit for one in scene.arms])
    motion = _fastest(at, polygon, fastest, np.full(scene.nq, float(acceleration)))
    samples = motion.duration * rate
    if samples > MOST_SAMPLES:
        expected = f"at most {MOST_SAMPLES} samples; the motion takes {motion.duration:.4g} s"
        raise InputError("timing", "rate", rate, expected)
    count = max(int(np.ceil(samples)), 1)
    time = np.linspace(0.0, motion.duration, count + 1)
    q, qd, qdd = (np.asarray(motion(time, order)) for order in (0, 1, 2))
    q[0], q[-1] = polygon[0], polygon[-1]
    return TimedMotion(scene, time, q, qd, qdd, _deviation(q, polygon))


def _polygon(scene: Scene, paths: Mapping[str, JointPath]) -> np.ndarray:
    index = np.unique(np.concatenate([path.index for path in paths.values()]))
    q = scene.stack(**{name: path.at(index) for name, path in paths.items()})
    return densify(q, SPACING)[0]


def _fastest(at: np.ndarray, path: np.ndarray, speed: np.ndarray, acceleration: np.ndarray) -> Any:
    toppra = quietly("toppra")
    constraint = toppra.constraint
    limits = [
        constraint.JointVelocityConstraint(np.column_stack([-speed, speed])),
        constraint.JointAccelerationConstraint(np.column_stack([-acceleration, acceleration])),
    ]
    grid = np.linspace(0.0, at[-1], max(_GRID, 2 * len(at)) + 1)
    method = toppra.algorithm.TOPPRA(limits, toppra.SplineInterpolator(at, path), gridpoints=grid)
    motion = method.compute_trajectory()
    if motion is None:
        raise InputError("timing", "path", len(path), "a path that can be timed within the limits")
    return motion


def _deviation(q: np.ndarray, polygon: np.ndarray) -> float:
    """Largest distance of rows from the nearest segment of a polygon, largest joint [rad]."""
    start, step = polygon[:-1], np.diff(polygon, axis=0)
    square = (step**2).sum(axis=1)
    worst = 0.0
    for row in q:
        share = np.clip(((row - start) * step).sum(axis=1) / square, 0.0, 1.0)
        away = np.abs(start + share[:, np.newaxis] * step - row).max(axis=1)
        worst = max(worst, float(away.min()))
    return worst
