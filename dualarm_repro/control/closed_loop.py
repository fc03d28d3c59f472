"""The exact controller in closed loop at a fixed rate, compiled."""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from .assembly import make_buffers, sense, state
from .certificate import residual
from .circle import follow
from .least_distance import SOLVED, least_distance
from .problem import CERTIFIED
from .relaxed import least_distance_with_slack

DONE, NO_SOLUTION, UNCERTIFIED, DIVERGED = range(4)
#: Why a run ended early.
REASONS = {
    NO_SOLUTION: "no joint velocity satisfies all constraints",
    UNCERTIFIED: "the solution failed its certificate",
    DIVERGED: "the network diverged",
}


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
def run_exact(arrays, numbers, circle, q0, steps, dt, slack_weight, noise, rows_per_pair):
    """q' = x(q, t) by explicit Euler steps, x the exact minimiser.

    Parameters
    ----------
    slack_weight : float
        Weight of the slack on the task where the problem has no solution; 0: stop there.
    noise : (steps, P) or (0, 0)
        Error of the distance readings [m].

    Returns
    -------
    status, taken : int
        How the run ended and after how many steps.
    q : (steps + 1, n)
    x : (steps, n)
    error : (steps + 1, A)
        Distance of each tip from its path [m].
    distance : (steps + 1,)
        Smallest surface distance [m].
    rows : (steps,)
    slack : (steps,)
        Norm of what the task gave up [m/s].
    """
    n, arms = len(q0), len(arrays.base)
    buffers = make_buffers(arrays, rows_per_pair)
    position, velocity = np.empty((arms, 3)), np.empty((arms, 3))
    q, x = np.empty((steps + 1, n)), np.empty((steps, n))
    error, distance = np.empty((steps + 1, arms)), np.empty(steps + 1)
    rows, slack = np.zeros(steps, np.int64), np.zeros(steps)
    q[0] = q0
    status = DONE
    B = buffers
    for step in range(steps + 1):
        reading = noise[step] if step < len(noise) else np.empty(0)
        count = sense(arrays, numbers, q[step], reading, buffers)
        follow(circle, step * dt, position, velocity)
        distance[step] = observe(B, position, error[step])
        if step == steps:
            break
        k = state(arrays, numbers, q[step], q0, position, velocity, count, buffers)
        G, h = B.G[:k], B.h[:k]
        found, v, y, z, w = least_distance(B.target, B.A, B.b, G, h, B.lower, B.upper)
        task = B.b
        if found != SOLVED and slack_weight > 0.0:
            found, v, y, z, w, s = least_distance_with_slack(
                B.target, B.A, B.b, G, h, B.lower, B.upper, slack_weight
            )
            slack[step] = np.sqrt((s * s).sum())
            task = B.b - s
        if found != SOLVED:
            status = NO_SOLUTION
        elif residual(B.target, B.A, task, G, h, B.lower, B.upper, v, y, z, w) > CERTIFIED:
            status = UNCERTIFIED
        if status != DONE:
            return status, step, q, x, error, distance, rows, slack
        rows[step] = k
        x[step] = v
        q[step + 1] = q[step] + dt * v
    return status, steps, q, x, error, distance, rows, slack
