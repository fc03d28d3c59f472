"""The network in closed loop at a fixed rate: an explicit Euler step of robot and state a tick."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...kernel import kernel
from ..assembly import make_buffers
from ..circle import Circles, follow
from ..closed_loop import DIVERGED, DONE, Run, observe
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
    q, x = np.empty((steps + 1, n)), np.empty((steps, n))
    error, distance = np.empty((steps + 1, arms)), np.empty(steps + 1)
    run = Run(q, x, error, distance, np.zeros(steps, np.int64), np.zeros(steps))
    q[0] = q0
    position, velocity = np.empty((arms, 3)), np.empty((arms, 3))
    y, rate = y0.copy(), np.empty(len(y0))
    for step in range(steps + 1):
        t = step * dt
        reading = noise[step] if step < len(noise) else np.empty(0)
        pushed = disturbance[step] if step < len(disturbance) else np.zeros(len(y))
        at = q[step], q0, t, y, reading, pushed
        rows = state_rate(arrays, numbers, network, circle, *at, B, rate)
        follow(circle, t, position, velocity)
        distance[step] = observe(B, position, error[step])
        if step == steps:
            break
        run.rows[step] = rows
        x[step] = y[:n]
        if not np.abs(y[:n]).max() < FASTEST:
            return DIVERGED, step, run
        q[step + 1] = q[step] + dt * y[:n]
        y += dt * rate
    return DONE, steps, run


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
    arguments = system.arrays, numbers, network.numbers(dt), circles.numbers(), q0, y0, steps, dt
    return truncated(system, dt, *run_network(*arguments, noise, disturbance))


def divergence_time(gamma: float, dt: float) -> float:
    """t at which gamma e^t dt = 2, the stability limit of Euler steps: ln(2 / (gamma dt)) [s]."""
    return float(np.log(2.0 / (gamma * dt)))
