"""The exact controller in closed loop at a fixed rate, compiled."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from ..kernel import kernel
from ..settings import code
from .assembly import make_buffers, sense, state
from .certificate import residual
from .circle import follow
from .least_distance import SOLVED, least_distance
from .parts import with_task
from .problem import CERTIFIED
from .readings import angles_at, noise_at
from .relaxed import least_distance_with_slack


class Ending(StrEnum):
    """How a run ended."""

    DONE = "done"
    NO_SOLUTION = "no joint velocity satisfies all constraints"
    UNCERTIFIED = "the solution failed its certificate"
    DIVERGED = "the network diverged"
    BLOCKED = "the path is blocked"


class Run(NamedTuple):
    """Where a loop of N steps writes what :class:`.motion.Motion` holds, see there."""

    q: np.ndarray
    x: np.ndarray
    error: np.ndarray
    distance: np.ndarray
    rows: np.ndarray
    slack: np.ndarray


DONE, DIVERGED = code(Ending.DONE), code(Ending.DIVERGED)
_NO_SOLUTION, _UNCERTIFIED = code(Ending.NO_SOLUTION), code(Ending.UNCERTIFIED)


@kernel
def observe(buffers, position, error):
    """Write the distance of each tip from its path; returns the smallest surface distance."""
    for arm in range(len(position)):
        square = 0.0
        for r in range(3):
            square += (position[arm, r] - buffers.tips[arm, r]) ** 2
        error[arm] = np.sqrt(square)
    return buffers.surface.min() if len(buffers.surface) else np.inf


@kernel
def run_exact(arrays, numbers, circle, q0, steps, dt, slack_weight, smoothing, readings):
    """q' = x(q, t) by explicit Euler steps, x the exact minimiser.

    With a smoothing w it minimises 1/2 |x - target|^2 + w/2 |x - x_before|^2, which is the same
    problem with the target (target + w x_before) / (1 + w).

    Parameters
    ----------
    slack_weight : float
        Weight of the slack on the task where the problem has no solution, against the whole of the
        rest of the objective; 0: stop there.
    smoothing : float
        w, which keeps an answer near the one before.
    readings : Readings

    Returns
    -------
    status, taken : int
        Number of the :class:`Ending`, and after how many steps.
    run : Run
    """
    n, arms, status = len(q0), len(arrays.base), DONE
    buffers = make_buffers(arrays, numbers)
    q, x = np.empty((steps + 1, n)), np.empty((steps, n))
    error, distance = np.empty((steps + 1, arms)), np.empty(steps + 1)
    run = Run(q, x, error, distance, np.zeros(steps, np.int64), np.zeros(steps))
    q[0] = q0
    position, velocity = np.empty((arms, 3)), np.empty((arms, 3))
    for step in range(steps + 1):
        noise, at = noise_at(readings, step), angles_at(readings, q, step)
        sense(arrays, numbers, q[step], noise, buffers)
        follow(circle, step * dt, position, velocity)
        distance[step] = observe(buffers, position, error[step])
        if step == steps:
            break
        count = sense(arrays, numbers, at, noise, buffers)
        program = state(arrays, numbers, at, q0, position, velocity, count, buffers)
        if smoothing > 0.0 and step > 0:
            program.target[:] = (program.target + smoothing * x[step - 1]) / (1.0 + smoothing)
        found, v, y, z, w = least_distance(program)
        if found != SOLVED and slack_weight > 0.0:
            found, v, y, z, w, s = least_distance_with_slack(program, slack_weight)
            run.slack[step] = np.sqrt((s * s).sum())
            program = with_task(program, program.b - s)
        if found != SOLVED:
            status = _NO_SOLUTION
        elif residual(program, v, y, z, w) > CERTIFIED:
            status = _UNCERTIFIED
        if status != DONE:
            return status, step, run
        run.rows[step] = len(program.h)
        x[step] = v
        q[step + 1] = q[step] + dt * v
    return status, steps, run
