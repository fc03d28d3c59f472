"""The network in closed loop at a fixed rate: an explicit Euler step of robot and state a tick."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...arguments import Joints, checked
from ...kernel import kernel
from ..assembly import make_buffers, sense
from ..circle import Circles, follow
from ..closed_loop import DIVERGED, DONE, Run, observe
from ..motion import Motion
from ..parts import ProgramParts
from ..readings import Readings, angles_at, noise_at, readings_for
from ..settings import ControllerSettings
from ..simulate import UNDISTURBED, Disturbance, checked_run, require_states, truncated
from ..system import ArmSystem
from .network import state_rate
from .network_settings import NetworkSettings
from .optimality import optimality

#: Joint speed [rad/s] beyond which the network counts as diverged.
FASTEST = 1e3


@kernel
def _in_use(program, rows):
    """The program with the rows in use."""
    target, A, b, G, h, lower, upper = program
    return ProgramParts(target, A, b, G[:rows], h[:rows], lower, upper)


@kernel
def run_network(arrays, numbers, network, circle, q0, y0, steps, dt, readings, disturbance):
    """q += dt x, y += dt dy/dt.

    Parameters
    ----------
    y0 : (n + m,)
        State of the network at the start.
    readings : Readings
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
    y, rate, F, total = y0.copy(), np.empty(len(y0)), np.empty(len(y0)), np.zeros(len(y0))
    for step in range(steps + 1):
        t = step * dt
        noise, seen = noise_at(readings, step), angles_at(readings, q, step)
        pushed = disturbance[step] if step < len(disturbance) else np.zeros(len(y))
        pushed = pushed - network.integral * total
        at = seen, q0, t, y, noise, pushed
        rows = state_rate(arrays, numbers, network, circle, *at, B, rate)
        if network.integral > 0.0:
            optimality(network, _in_use(B.program, rows), y, F)
            total += dt * F
        sense(arrays, numbers, q[step], noise, B)
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


@checked
def simulate_network(
    system: ArmSystem,
    circles: Circles,
    q0: ArrayLike,
    settings: ControllerSettings,
    network: NetworkSettings,
    *,
    dt: float = 1e-3,
    cycles: int = 1,
    readings: Readings | None = None,
    disturbance: Disturbance = UNDISTURBED,
    y0: Joints | None = None,
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
    readings = readings_for(system, readings)
    require_states("simulate_network", system, disturbance, y0)
    return truncated(system, dt, *run_network(*arguments, readings, disturbance))


def divergence_time(gamma: float, dt: float) -> float:
    """t at which gamma e^t dt = 2, the stability limit of Euler steps: ln(2 / (gamma dt)) [s]."""
    return float(np.log(2.0 / (gamma * dt)))
