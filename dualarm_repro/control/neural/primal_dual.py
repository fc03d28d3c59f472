"""The earlier primal-dual network on linear variational inequalities (LVI-PDNN).

u = [x; y; z] with lower <= x <= upper, z >= 0 and

    M = [I, -A^T, G^T;  A, 0, 0;  -G, 0, 0],   p = [-target; -b; h],
    e(u) = u - Proj(u - (M u + p)),            du/dt = -gamma (I + M^T) e(u).

Rest points u* are the minimisers. M being monotone, (u - u*) . (I + M^T) e >= |e|^2 for each; the
iteration u -= |e|^2 / |(I + M^T) e|^2 (I + M^T) e projects onto that half-space, after B. He, A new
method for a class of linear variational inequalities, Math. Programming 66, 1994.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...arguments import Count, checked
from ...errors import InputError
from ...kernel import kernel
from ..assembly import make_buffers, sense, state
from ..circle import Circles, follow
from ..closed_loop import DIVERGED, DONE, Run, observe
from ..motion import Motion
from ..readings import Readings, angles_at, noise_at, readings_for
from ..settings import ControllerSettings, RowForm
from ..simulate import UNDISTURBED, Disturbance, checked_run, require_states, truncated
from ..system import ArmSystem
from .fixed_step import FASTEST


@kernel
def projection_error(program, u, e):
    """e(u) (n + m + k,)."""
    target, A, b, G, h, lower, upper = program
    n, m, k = len(target), len(b), len(h)
    for i in range(n):
        total = u[i] - target[i]
        for j in range(m):
            total -= A[j, i] * u[n + j]
        for j in range(k):
            total += G[j, i] * u[n + m + j]
        e[i] = u[i] - min(max(u[i] - total, lower[i]), upper[i])
    for j in range(m):
        total = -b[j]
        for i in range(n):
            total += A[j, i] * u[i]
        e[n + j] = total
    for j in range(k):
        total = h[j]
        for i in range(n):
            total -= G[j, i] * u[i]
        e[n + m + j] = u[n + m + j] - max(u[n + m + j] - total, 0.0)


@kernel
def direction(program, e, d):
    """d = (I + M^T) e."""
    A, G = program.A, program.G
    n, m, k = A.shape[1], len(A), len(G)
    d[:] = e
    for i in range(n):
        d[i] += e[i]
        for j in range(m):
            d[i] += A[j, i] * e[n + j]
        for j in range(k):
            d[i] -= G[j, i] * e[n + m + j]
    for j in range(m):
        for i in range(n):
            d[n + j] -= A[j, i] * e[i]
    for j in range(k):
        for i in range(n):
            d[n + m + j] += G[j, i] * e[i]


@kernel
def iterate(program, u, iterations, tolerance):
    """Improve ``u`` in place; returns the iterations made until |e|_inf <= tolerance, or all."""
    e, d = np.empty(len(u)), np.empty(len(u))
    for made in range(iterations):
        projection_error(program, u, e)
        if np.abs(e).max() <= tolerance:
            return made
        direction(program, e, d)
        u -= ((e * e).sum() / (d * d).sum()) * d
    return iterations


@kernel
def flow(program, u, step, count):
    """``count`` Euler steps of du/ds = -(I + M^T) e(u) in place."""
    e, d = np.empty(len(u)), np.empty(len(u))
    for _ in range(count):
        projection_error(program, u, e)
        direction(program, e, d)
        u -= step * d


@kernel
def run_primal_dual(arrays, numbers, circle, q0, iterations, steps, dt, readings, disturbance):
    """Closed loop with a fixed number of iterations per tick, multipliers kept from tick to tick.

    ``disturbance`` (steps, n + m) is added to dx and dy of every tick, scaled by the step. One row
    per pair. Returns what :func:`..closed_loop.run_exact` does, ``slack`` being zero.
    """
    n, arms = len(q0), len(arrays.base)
    m = 3 * arms
    B = make_buffers(arrays, numbers)
    q, x = np.empty((steps + 1, n)), np.empty((steps, n))
    error, distance = np.empty((steps + 1, arms)), np.empty(steps + 1)
    run = Run(q, x, error, distance, np.zeros(steps, np.int64), np.zeros(steps))
    q[0] = q0
    position, velocity = np.empty((arms, 3)), np.empty((arms, 3))
    kept, pair_kept = np.zeros(n + m), np.zeros(len(arrays.pairs))
    for step in range(steps + 1):
        noise, at = noise_at(readings, step), angles_at(readings, q, step)
        sense(arrays, numbers, q[step], noise, B)
        follow(circle, step * dt, position, velocity)
        distance[step] = observe(B, position, error[step])
        if step == steps:
            break
        count = sense(arrays, numbers, at, noise, B)
        program = state(arrays, numbers, at, q0, position, velocity, count, B)
        k = len(program.h)
        u = np.empty(n + m + k)
        u[: n + m] = kept
        for j in range(k):
            u[n + m + j] = pair_kept[B.chosen[j]]
        iterate(program, u, iterations, 0.0)
        if step < len(disturbance):
            u[: n + m] += dt * disturbance[step]
        kept[:] = u[: n + m]
        pair_kept[:] = 0.0
        for j in range(k):
            pair_kept[B.chosen[j]] = u[n + m + j]
        run.rows[step] = k
        x[step] = u[:n]
        if not np.abs(u[:n]).max() < FASTEST:
            return DIVERGED, step, run
        q[step + 1] = q[step] + dt * u[:n]
    return DONE, steps, run


@checked
def simulate_primal_dual(
    system: ArmSystem,
    circles: Circles,
    q0: ArrayLike,
    settings: ControllerSettings,
    *,
    iterations: Count = 100,
    dt: float = 1e-3,
    readings: Readings | None = None,
    disturbance: Disturbance = UNDISTURBED,
) -> Motion:
    """Follow the circles with ``iterations`` steps of the primal-dual network per tick.

    Raises
    ------
    InputError
        As :func:`..simulate.simulate`; a form of the avoidance with several rows per pair, or
        iterations that are not positive.
    """
    q0, numbers, steps = checked_run(system, circles, q0, settings, dt, 1)
    if settings.form is not RowForm.PAIR_NORMAL:
        raise InputError("simulate_primal_dual", "form", settings.form, "pair_normal")
    arguments = system.arrays, numbers, circles.numbers(), q0, iterations, steps, dt
    readings = readings_for(system, readings)
    require_states("simulate_primal_dual", system, disturbance)
    return truncated(system, dt, *run_primal_dual(*arguments, readings, disturbance))
