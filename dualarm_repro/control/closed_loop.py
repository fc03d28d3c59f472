"""The exact controller in closed loop at a fixed rate, compiled."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from ..kernel import kernel
from ..settings import code
from .assembly import sense_near, state
from .certificate import residual
from .circle import follow
from .few_constraints import minimise
from .least_distance import SOLVED
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
def tip_errors(buffers, position, error):
    """Write the distance of each tip from its path."""
    for arm in range(len(position)):
        square = 0.0
        for r in range(3):
            square += (position[arm, r] - buffers.tips[arm, r]) ** 2
        error[arm] = np.sqrt(square)


@kernel
def observe(buffers, position, error):
    """Write the distance of each tip from its path; returns the smallest surface distance."""
    tip_errors(buffers, position, error)
    return buffers.surface.min() if len(buffers.surface) else np.inf


@kernel
def make_run(n, arms, q0, steps):
    """A run of so many steps that begins at q0."""
    q, x = np.empty((steps + 1, n)), np.empty((steps, n))
    error, distance = np.empty((steps + 1, arms)), np.empty(steps + 1)
    q[0] = q0
    return Run(q, x, error, distance, np.zeros(steps, np.int64), np.zeros(steps))


@kernel
def run_exact(arrays, numbers, circle, first, last, dt, weights, readings, run, buffers, work):
    """q' = x(q, t) by explicit Euler steps ``first`` ... ``last`` - 1, x the exact minimiser.

    With a smoothing w it minimises 1/2 |x - target|^2 + w/2 |x - x_before|^2, which is the same
    problem with the target (target + w x_before) / (1 + w). A whole run would not hear a user who
    wants to stop it: the caller asks for some steps at a time.

    Parameters
    ----------
    weights : (2,)
        Of the slack on the task where the problem has no solution, against the whole of the rest of
        the objective (0: stop there), and w, which keeps an answer near the one before.
    readings : Readings
    run : Run
        Written where the steps have been taken.
    buffers, work
        Of :func:`.assembly.make_buffers` and :func:`.few_constraints.make_work`; after a failure
        they hold the problem.

    Returns
    -------
    status, step, rows : int
        Number of the :class:`Ending`, the first step not taken, and how many rows it has.
    """
    q, x, arms, steps = run.q, run.x, len(arrays.base), len(run.x)
    position, velocity = np.empty((arms, 3)), np.empty((arms, 3))
    slack_weight, smoothing = weights
    for step in range(first, last):
        noise, at = noise_at(readings, step), angles_at(readings, q, step)
        count, smallest = sense_near(arrays, numbers, q[step], noise, buffers)
        follow(circle, step * dt, position, velocity)
        tip_errors(buffers, position, run.error[step])
        run.distance[step] = smallest
        if step == steps:
            break
        if not (at == q[step]).all():
            count, _ = sense_near(arrays, numbers, at, noise, buffers)
        program = state(arrays, numbers, at, q[0], position, velocity, count, buffers)
        if smoothing > 0.0 and step > 0:
            for j in range(len(program.target)):
                together = program.target[j] + smoothing * x[step - 1, j]
                program.target[j] = together / (1.0 + smoothing)
        found = minimise(program, work)
        v, y, z, w = work.x, work.y, work.z, work.w
        if found != SOLVED and slack_weight > 0.0:
            found, v, y, z, w, s = least_distance_with_slack(program, slack_weight)
            run.slack[step] = np.sqrt((s * s).sum())
            program = with_task(program, program.b - s)
        if found != SOLVED:
            return _NO_SOLUTION, step, len(program.h)
        if not residual(program, v, y, z, w) <= CERTIFIED:
            return _UNCERTIFIED, step, len(program.h)
        take(run, step, v, len(program.h), dt)
    return DONE, last, 0


@kernel
def take(run, step, velocity, rows, dt):
    """One Euler step."""
    run.rows[step] = rows
    for i in range(len(velocity)):
        run.x[step, i] = velocity[i]
        run.q[step + 1, i] = run.q[step, i] + dt * velocity[i]
