"""A guard around the network: detect what its soft inequalities let through, slow down, hand over.

A tick takes the network's answer if it violates nothing by more than a tolerance. Else the exact
minimiser takes over, and slows the path down where it has to:

    A x = sigma dr/dt + K (r - f),   0 <= sigma <= 1, lowered until there is a solution,

so that the path time goes on by sigma dt. Speed comes back slowly, and at full speed the network
starts again from the exact answer. A path that comes to a standstill is blocked, which is reported.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...kernel import kernel
from ...settings import code
from ..assembly import make_buffers, sense, state
from ..circle import Circles, follow
from ..closed_loop import DONE, Ending, Run, observe
from ..least_distance import SOLVED, least_distance
from ..motion import Motion
from ..settings import ControllerSettings
from ..simulate import checked_run, truncated
from ..system import ArmSystem
from .network import state_rate
from .network_settings import NetworkSettings

#: Violation that the network may have [m/s], [rad/s]: with a damper of 5 1/s it costs 2 mm.
TOLERANCE = 1e-2
_LOWERED = 0.95  # factor by which the share of the speed along the path is lowered
_SLOWEST = 0.01  # share of the speed below which the path stands still
_RECOVERY = 0.2  # time in which the full speed comes back [s]
_PATIENCE = 100  # ticks at a standstill after which a path counts as blocked
_LONGEST = 4  # times the duration of the path that a run may take
_BLOCKED = code(Ending.BLOCKED)


class Shares(NamedTuple):
    """Shares of the ticks that were handed over, and of those that were slowed down."""

    handed_over: float
    slowed: float


@kernel
def violation(program, x):
    """Largest violation of task, rows or bounds by a joint velocity; infinite if not finite."""
    worst = 0.0
    for k in range(len(program.b)):
        worst = max(worst, abs((program.A[k] * x).sum() - program.b[k]))
    for k in range(len(program.h)):
        worst = max(worst, (program.G[k] * x).sum() - program.h[k])
    for i in range(len(x)):
        worst = max(worst, x[i] - program.upper[i], program.lower[i] - x[i])
    return worst if np.isfinite(x).all() else np.inf


@kernel
def run_guarded(arrays, numbers, network, circle, q0, steps, dt, tolerance):
    """As :func:`.fixed_step.run_network`, with guard, and the ticks it took over and slowed.

    ``steps`` is the number of ticks at full speed.
    """
    n, arms, most = len(q0), len(arrays.base), _LONGEST * steps
    B, nothing = make_buffers(arrays, numbers), np.empty(0)
    q, x = np.empty((most + 1, n)), np.empty((most, n))
    error, distance = np.empty((most + 1, arms)), np.empty(most + 1)
    run = Run(q, x, error, distance, np.zeros(most, np.int64), np.zeros(most))
    q[0] = q0
    position, velocity = np.empty((arms, 3)), np.empty((arms, 3))
    y, rate, still = np.zeros(n + 3 * arms), np.empty(n + 3 * arms), np.zeros(n + 3 * arms)
    t, sigma, handed, slowed, standing, end = 0.0, 1.0, 0, 0, 0, (steps - 0.5) * dt
    for step in range(most + 1):
        count = sense(arrays, numbers, q[step], nothing, B)
        follow(circle, t, position, velocity)
        distance[step] = observe(B, position, error[step])
        if t > end:
            return DONE, step, run, handed, slowed
        if step == most or standing > _PATIENCE:
            return _BLOCKED, step, run, handed, slowed
        program = state(arrays, numbers, q[step], q0, position, velocity, count, B)
        run.rows[step] = len(program.h)
        if sigma == 1.0 and violation(program, y[:n]) <= tolerance:
            x[step] = np.minimum(np.maximum(y[:n], program.lower), program.upper)
            at = q[step], q0, t, y, nothing, still
            state_rate(arrays, numbers, network, circle, *at, B, rate)
            y += dt * rate
        else:
            handed += 1
            task = program.b.copy()
            sigma = min(1.0, sigma + dt / _RECOVERY)
            while True:
                program.b[:] = task - (1.0 - sigma) * velocity.ravel()
                found, v, multiplier, _, _ = least_distance(program)
                if found == SOLVED or sigma == 0.0:
                    break
                sigma = _LOWERED * sigma if sigma > _SLOWEST else 0.0
            if found != SOLVED:
                return _BLOCKED, step, run, handed, slowed
            slowed += sigma < 1.0
            standing = standing + 1 if sigma == 0.0 else 0
            x[step], y[:n], y[n:] = v, v, multiplier
        q[step + 1] = q[step] + dt * x[step]
        t += sigma * dt
    return DONE, most, run, handed, slowed


def simulate_guarded(
    system: ArmSystem,
    circles: Circles,
    q0: ArrayLike,
    settings: ControllerSettings,
    network: NetworkSettings,
    *,
    dt: float = 1e-3,
    tolerance: float = TOLERANCE,
) -> tuple[Motion, Shares]:
    """Follow the circles once with the guarded network, more slowly where task and bounds exclude.

    Returns
    -------
    Motion, Shares
        Its time is that of the clock, longer than the path where the motion was slowed down.

    Raises
    ------
    ConfigurationError, InputError
        As :func:`..simulate.simulate`.
    """
    q0, numbers, steps = checked_run(system, circles, q0, settings, dt, 1)
    arguments = system.arrays, numbers, network.numbers(dt), circles.numbers(), q0, steps, dt
    status, taken, run, handed, slowed = run_guarded(*arguments, tolerance)
    ticks = max(taken, 1)
    return truncated(system, dt, status, taken, run), Shares(handed / ticks, slowed / ticks)
