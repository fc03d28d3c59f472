"""The network in closed loop at a fixed rate: an explicit Euler step of robot and state a tick."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...kernel import kernel
from ..assembly import make_buffers
from ..circle import Circles, follow
from ..closed_loop import DIVERGED, DONE, observe
from ..motion import Motion
from ..settings import ControllerSettings
from ..simulate import UNDISTURBED, checked_run, truncated
from ..system import ArmSystem
from .network import state_rate
from .network_settings import NetworkSettings

#: Joint speed [rad/s] beyond which the network counts as diverged.
FASTEST = 1e3


@kernel
def run_network(arrays, numbers, network, circle, q0, y0, steps, dt, noise, disturbance):
    """q += dt x, y += dt dy/dt.

    Parameters
    ----------
    y0 : (n + m,)
        State of the network at the start.
    noise : (steps, P) or (0, 0)
        Error of the distance readings [m].
    disturbance : (steps, n + m) or (0, 0)
        Added to the right-hand side of the state equation.

    Returns
    -------
    As :func:`..closed_loop.run_exact`, ``slack`` being zero.
    """
    n, arms = len(q0), len(arrays.base)
    B = make_buffers(arrays, numbers)
    position, velocity = np.empty((arms, 3)), np.empty((arms, 3))
    q, x = np.empty((steps + 1, n)), np.empty((steps, n))
    error, distance = np.empty((steps + 1, arms)), np.empty(steps + 1)
    rows = np.zeros(steps, np.int64)
    q[0] = q0
    y, rate = y0.copy(), np.empty(len(y0))
    for step in range(steps + 1):
        t = step * dt
        reading = noise[step] if step < len(noise) else np.empty(0)
        pushed = disturbance[step] if step < len(disturbance) else np.zeros(len(y))
        rows_used = state_rate(
            arrays, numbers, network, circle, q[step], q0, t, y, reading, pushed, B, rate
        )
        follow(circle, t, position, velocity)
        distance[step] = observe(B, position, error[step])
        if step == steps:
            break
        rows[step] = rows_used
        x[step] = y[:n]
        if not np.abs(y[:n]).max() < FASTEST:
            return DIVERGED, step, q, x, error, distance, rows
        q[step + 1] = q[step] + dt * y[:n]
        y += dt * rate
    return DONE, steps, q, x, error, distance, rows


def simulate_network(
    system: ArmSystem,
    circles: Circles,
    q0: ArrayLike,
    settings: ControllerSettings,
    network: NetworkSettings,
    *,
    dt: float = 1e-3,
    cycles: int = 1,
    noise: np.ndarray = UNDISTURBED,
    disturbance: np.ndarray = UNDISTURBED,
    y0: np.ndarray | None = None,
) -> Motion:
    """Follow the circles with the network at a fixed rate; the state starts at zero unless given.

    Raises
    ------
    ConfigurationError, InputError
        As :func:`..simulate.simulate`.
    """
    q0, numbers, steps = checked_run(system, circles, q0, settings, dt, cycles)
    y0 = np.zeros(system.nq + 3 * len(system.arms)) if y0 is None else y0
    status, taken, q, x, error, distance, rows = run_network(
        *(system.arrays, numbers, network.numbers(dt), circles.numbers(), q0, y0, steps, dt),
        *(noise, disturbance),
    )
    return truncated(status, taken, dt, q, x, error, distance, rows, np.zeros(steps))


def divergence_time(gamma: float, dt: float) -> float:
    """t at which gamma e^t dt = 2, the stability limit of Euler steps: ln(2 / (gamma dt)) [s]."""
    return float(np.log(2.0 / (gamma * dt)))
