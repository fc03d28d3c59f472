"""The fastest timing of a path of all arms that keeps their limits, from rest to rest.

max over s'(s) under |q'(s) s'| <= v and |q''(s) s'^2 + q'(s) s''| <= a, by reachability analysis on
a grid: H. Pham and Q.-C. Pham, A new approach to time-optimal path parameterization based on
reachability analysis, IEEE Trans. Robotics 34(3), 2018 (toppra). The path becomes a cubic spline
through its rows, which leaves the polygon between them by a little: what is timed has to be judged
again, and says how far it is away. The analysis keeps the limits at the points of its grid alone;
between them the extrema are computed exactly (:mod:`.timed_spline`), the grid is refined while they
exceed the limits, and what is left is taken away by running the motion more slowly.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy

from ...errors import InputError
from ...quiet_import import quietly
from ...scene import JointPath, Scene, densify
from ...scene.quantities import positive
from ..checks.whole_motion import require_paths
from ..field.control_points import end_effector
from .timed_spline import TimedSpline

#: Rows of a path are no further apart than this before the spline goes through them [rad].
SPACING = 0.02
#: Most samples of a timed motion: half an hour at a hundred a second.
MOST_SAMPLES = 200_000
#: Most rows of a path after that: two thousand radians.
MOST_ROWS = 100_000
#: Between two samples the motion leaves the straight line by at most this [rad].
SAG = 1e-3
#: Steps shorter than this are one row [rad].
_SAME = 1e-9
#: Least pieces of the grid of the reachability analysis, and how often they are halved until the
#: limits hold but for this share of the speed.
_GRID, _REFINED, _ENOUGH = 400, 3, 0.01


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
        Largest distance of the motion, at any time, from the path that was to be timed, of any
        joint [rad].
    fullest_speed, fullest_acceleration : float
        Largest share of the limits that is used, of any joint at any time; at most 1.
    passed : JointPath
        The motion over the time [s], at its samples and at all points of the grid.
    """

    scene: Scene
    time: np.ndarray
    q: np.ndarray
    speed: np.ndarray
    acceleration: np.ndarray
    deviation: float
    fullest_speed: float
    fullest_acceleration: float
    passed: JointPath

    @property
    def duration(self) -> float:
        """[s]"""
        return float(self.time[-1])

    @property
    def paths(self) -> dict[str, JointPath]:
        """Of every arm over the time, to be judged."""
        columns = self.scene.columns.items()
        q, time = self.passed.configurations, self.passed.index
        return {name: JointPath(q[:, part], time) for name, part in columns}

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
        A limit that is not positive, obstacles that move by themselves, a path that rests, is too
        long or cannot be timed, more samples than :data:`MOST_SAMPLES`, or so few that the motion
        between them is further than :data:`SAG` from straight.
    """
    require_paths("timing", scene, paths)
    speed = positive("timing", "speed", speed, "share of the limits")
    acceleration = positive("timing", "acceleration", acceleration, "rad/s^2")
    rate = positive("timing", "rate", rate, "1/s")
    if speed > 1.0:
        raise InputError("timing", "speed", speed, "a share of the speed limits, at most 1")
    if moving := [n for n, one in scene.moving.items() if len(one.path.index) > 1]:
        expected = "a scene in which only the arms move: at another time they are elsewhere"
        raise InputError("timing", "moving", moving[0], expected)
    polygon = _moved(_polygon(scene, paths))
    if len(polygon) < 2:
        raise InputError("timing", "path", len(polygon), "a path along which an arm moves")
    fastest = speed * np.concatenate([one.arm.velocity_limit for one in scene.arms])
    if not (fastest > 0.0).all():
        joint = int(np.argmin(fastest > 0.0))
        expected = "speed limits above 0 in the robot files"
        raise InputError("timing", f"speed limit of joint {joint + 1}", fastest[joint], expected)
    motion, shares = _within(polygon, fastest, np.full(scene.nq, acceleration))
    duration = float(motion.time[-1])
    if duration * rate > MOST_SAMPLES:
        expected = f"at most {MOST_SAMPLES} samples; the motion takes {duration:.4g} s"
        raise InputError("timing", "rate", rate, expected)
    time = np.linspace(0.0, duration, max(int(np.ceil(duration * rate)), 1) + 1)
    bend = shares[1] * acceleration
    if bend * time[1] ** 2 / 8.0 > SAG:
        expected = (
            f"at least {np.ceil(np.sqrt(bend / (8.0 * SAG))):g} samples a second, so that the "
            f"motion stays within {SAG:g} rad of the straight lines between them"
        )
        raise InputError("timing", "rate", rate, expected)
    q, qd, qdd = motion.at(time)
    q[0], q[-1] = polygon[0], polygon[-1]
    every, first = np.unique(np.concatenate([time, motion.time]), return_index=True)
    passed = JointPath(np.concatenate([q, motion.at(motion.time)[0]])[first], every)
    return TimedMotion(scene, time, q, qd, qdd, motion.away_from_chords(), *shares, passed)


def _polygon(scene: Scene, paths: Mapping[str, JointPath]) -> np.ndarray:
    index = np.unique(np.concatenate([path.index for path in paths.values()]))
    q = scene.stack(**{name: path.at(index) for name, path in paths.items()})
    way = float(np.abs(np.diff(q, axis=0)).max(axis=1, initial=0.0).sum())
    if way / SPACING + len(q) > MOST_ROWS:
        expected = f"at most {MOST_ROWS} rows that are {SPACING:g} rad apart"
        raise InputError("timing", "path", f"{len(q)} rows over {way:.4g} rad", expected)
    return densify(q, SPACING)[0]


def _moved(polygon: np.ndarray) -> np.ndarray:
    """The rows without those that are where the last one is that is kept."""
    kept = [0]
    for k in range(1, len(polygon)):
        if np.abs(polygon[k] - polygon[kept[-1]]).max() > _SAME:
            kept.append(k)
    return polygon[kept]


def _within(
    polygon: np.ndarray, speed: np.ndarray, acceleration: np.ndarray
) -> tuple[TimedSpline, tuple[float, float]]:
    """A motion through the rows that keeps its limits everywhere, and the shares it uses."""
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(polygon, axis=0), axis=1))])
    pieces = max(2, -(-_GRID // (len(at) - 1)))
    for _ in range(_REFINED):
        motion = _fastest(at, polygon, pieces, speed, acceleration)
        factor = _excess(motion, speed, acceleration)
        if factor <= 1.0 + _ENOUGH:
            break
        pieces *= 2
    if factor > 1.0:
        motion = motion.slowed(factor * (1.0 + 1e-12))
    fast, sharp = motion.largest()
    return motion, (float((fast / speed).max()), float((sharp / acceleration).max()))


def _excess(motion: TimedSpline, speed: np.ndarray, acceleration: np.ndarray) -> float:
    """How many times as long the motion has to take to keep the limits."""
    fast, sharp = motion.largest()
    return max(float((fast / speed).max()), float(np.sqrt((sharp / acceleration).max())))


def _fastest(
    at: np.ndarray, path: np.ndarray, pieces: int, speed: np.ndarray, acceleration: np.ndarray
) -> TimedSpline:
    """By toppra, on a grid of so many pieces between two rows."""
    toppra = quietly("toppra")
    constraint = toppra.constraint
    limits = [
        constraint.JointVelocityConstraint(np.column_stack([-speed, speed])),
        constraint.JointAccelerationConstraint(np.column_stack([-acceleration, acceleration])),
    ]
    share = np.arange(pieces) / pieces
    grid = np.append((at[:-1, np.newaxis] + np.outer(np.diff(at), share)).ravel(), at[-1])
    method = toppra.algorithm.TOPPRA(limits, toppra.SplineInterpolator(at, path), gridpoints=grid)
    _, rate, _ = method.compute_parameterization(0.0, 0.0)
    if rate is None or not np.isfinite(rate).all() or (rate[:-1] + rate[1:] <= 0.0).any():
        raise InputError("timing", "path", len(path), "a path that can be timed within the limits")
    return TimedSpline(scipy.interpolate.CubicSpline(at, path), grid, np.square(rate))
