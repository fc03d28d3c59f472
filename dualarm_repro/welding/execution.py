"""How fast a job can be executed: arc speed, turning of the joints, time parametrisation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from ..errors import InputError
from ..quiet_import import quietly
from .cell import ROBOTS, Cell
from .motion import periodic_derivative
from .placement import Jobs


class ArcSpeed(NamedTuple):
    """The largest constant speed of the torch along the seam [m/s], and what limits it.

    ``robot``, ``joint`` (from 1) and ``point`` of the seam at which a joint is at its limit.
    """

    speed: float
    robot: str
    joint: int
    point: int


@dataclass(frozen=True, eq=False)
class Weld:
    """A timed weld: time (T,) [s], seam (T,) [m], joints (T, 3, 6) [rad], and their rates."""

    time: np.ndarray
    seam: np.ndarray
    q: np.ndarray
    speed: np.ndarray
    acceleration: np.ndarray


def seam_rate(cell: Cell) -> np.ndarray:
    """|dp_c/dtheta| of the seam at its points (N,) [m]."""
    return np.linalg.norm(periodic_derivative(cell.seam), axis=1)


def joint_rates(cell: Cell, jobs: Jobs) -> np.ndarray:
    """dq/ds of the first job along the seam, (3, N, 6) [rad/m]."""
    path = jobs.q[0].swapaxes(0, 1)
    return (periodic_derivative(path) / seam_rate(cell)[:, np.newaxis, np.newaxis]).swapaxes(0, 1)


def speed_limits(cell: Cell) -> np.ndarray:
    """Speed limits of the joints (3, 6) [rad/s]."""
    return np.stack([arm.model.upperVelocityLimit[: arm.nq] for arm in cell.arms])


def arc_speed(cell: Cell, jobs: Jobs) -> ArcSpeed:
    """min over robots, joints and points of v_j / |dq_j/ds| on the first job.

    At this constant speed of the torch along the seam one joint reaches its speed limit.
    """
    rates = abs(joint_rates(cell, jobs))
    speeds = speed_limits(cell)[:, np.newaxis] / np.maximum(rates, 1e-12)
    robot, point, joint = np.unravel_index(speeds.argmin(), speeds.shape)
    return ArcSpeed(float(speeds.min()), ROBOTS[int(robot)], int(joint) + 1, int(point))


def joint_travel(cell: Cell, jobs: Jobs) -> np.ndarray:
    """Sum over robots and joints of their ways along the closed seam, (P,) [rad]."""
    return abs(np.diff(jobs.q, axis=2, append=jobs.q[:, :, :1])).sum(axis=(1, 2, 3))


def squared_speed(cell: Cell, jobs: Jobs) -> np.ndarray:
    """Mean of |dq/dtheta|^2 along the seam, (P,) [rad^2]: what speed squared costs."""
    step = 2 * np.pi / cell.count
    changes = np.diff(jobs.q, axis=2, append=jobs.q[:, :, :1]) / step
    return (changes**2).sum(axis=(1, 3)).mean(axis=1)


def peak_speed(cell: Cell, jobs: Jobs) -> np.ndarray:
    """Largest |dq_j/dtheta| over its limit, (P,) [s]: the least time per radian of the seam."""
    step = 2 * np.pi / cell.count
    changes = abs(np.diff(jobs.q, axis=2, append=jobs.q[:, :, :1])) / step
    return (changes / speed_limits(cell)[:, np.newaxis]).max(axis=(1, 2, 3))


#: Name to a proxy for effort: smaller is better.
EFFORTS = {"joint_travel": joint_travel, "squared_speed": squared_speed, "peak_speed": peak_speed}


def timed(
    cell: Cell, jobs: Jobs, speed: float, acceleration: float, start: int = 0, samples: int = 400
) -> Weld:
    """The fastest timing of the first job, from rest to rest, that keeps every limit.

    Time-optimal parametrisation of a path by reachability analysis on a grid, with the arc as a
    nineteenth coordinate: H. Pham and Q.-C. Pham, A new approach to time-optimal path
    parameterization based on reachability analysis, IEEE Trans. Robotics 34(3), 2018.

    Parameters
    ----------
    speed : float
        Largest speed of the torch along the seam [m/s].
    acceleration : float
        Largest joint acceleration [rad/s^2].
    start : int
        Seam point at which the weld begins and ends.

    Raises
    ------
    InputError
        A speed or acceleration that is not positive, or no timing.
    """
    toppra = quietly("toppra")
    constraint = toppra.constraint
    for name, value in (("speed", speed), ("acceleration", acceleration)):
        if not value > 0:
            raise InputError("weld", name, value, "a positive number")
    path = np.roll(jobs.q[0].swapaxes(0, 1).reshape(cell.count, -1), -start, axis=0)
    rate = np.roll(seam_rate(cell), -start)
    theta = 2 * np.pi * np.arange(cell.count + 1) / cell.count
    arc = CubicSpline(theta, np.append(rate, rate[0]), bc_type="periodic").antiderivative()(theta)
    whole = np.column_stack([np.vstack([path, path[:1]]), arc])
    curve = toppra.SplineInterpolator(theta, whole)
    fastest = np.append(speed_limits(cell).ravel(), speed)
    most = np.append(np.full(path.shape[1], acceleration), 1e3)
    limits = [
        constraint.JointVelocityConstraint(np.column_stack([-fastest, fastest])),
        constraint.JointAccelerationConstraint(np.column_stack([-most, most])),
    ]
    method = toppra.algorithm.TOPPRA(
        limits, curve, gridpoints=np.linspace(0, theta[-1], samples + 1)
    )
    motion = method.compute_trajectory()
    if motion is None:
        raise InputError("weld", "path", cell.count, "a path that can be timed within the limits")
    time = np.linspace(0.0, motion.duration, samples + 1)
    q, qd, qdd = (motion(time, order) for order in (0, 1, 2))
    shape = (-1, len(ROBOTS), 6)
    return Weld(
        time, q[:, -1], q[:, :-1].reshape(shape), qd[:, :-1].reshape(shape),
        qdd[:, :-1].reshape(shape),
    )  # fmt: skip
