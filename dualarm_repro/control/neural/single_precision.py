"""The network at a fixed rate as a processor with single precision would run it.

Matrix, error and state are held in 32 bits, and the linear system is solved in them; kinematics,
distances and the rates of the problem come from the arm in 64 bits.
"""

from __future__ import annotations

import numpy as np

from ..circle import Circles
from ..closed_loop import DONE, Run
from ..controller import VelocityController
from ..motion import Motion
from ..settings import ControllerSettings
from ..simulate import checked_run, truncated
from ..system import ArmSystem
from .activation import activation
from .network import HALF_STEP, gain_at
from .network_settings import NetworkSettings
from .penalised import code_error, state_matrix


def simulate_in_single_precision(
    system: ArmSystem,
    circles: Circles,
    q0: np.ndarray,
    settings: ControllerSettings,
    network: NetworkSettings,
    *,
    dt: float = 1e-3,
) -> Motion:
    """Follow the circles once; see :func:`.fixed_step.simulate_network`.

    The rows that the central difference sees are those at its ends, which may be more or fewer
    where a pair enters the outer range.

    Raises
    ------
    ConfigurationError, InputError
        As :func:`..simulate.simulate`.
    """
    q0, _, steps = checked_run(system, circles, q0, settings, dt, 1)
    controller, numbers = VelocityController(system, settings, home=q0), network.numbers(dt)
    n, arms = system.nq, len(system.arms)
    q, x = np.empty((steps + 1, n)), np.empty((steps, n))
    error, distance = np.empty((steps + 1, arms)), np.empty(steps + 1)
    run = Run(q, x, error, distance, np.zeros(steps, np.int64), np.zeros(steps))
    q[0], y = q0, np.zeros(n + 3 * arms, np.float32)
    for step in range(steps + 1):
        t = step * dt
        position, velocity = circles.at(t)
        p = controller.problem(q[step], position, velocity)
        distance[step] = controller.distance
        error[step] = np.linalg.norm(position - controller.tips, axis=1)
        if step == steps:
            break
        state = y.astype(float)
        ends = [
            code_error(
                controller.problem(q[step] + s * state[:n], *circles.at(t + s)), network, state
            )
            for s in (HALF_STEP, -HALF_STEP)
        ]
        drift = ((ends[0] - ends[1]) / (2 * HALF_STEP)).astype(np.float32)
        xi = code_error(p, network, state).astype(np.float32)
        shaped = np.array([activation(numbers.activation, v) for v in xi], np.float32)
        right = -drift - np.float32(gain_at(numbers, t)) * shaped
        run.rows[step], x[step] = len(p.h), state[:n]
        q[step + 1] = q[step] + dt * state[:n]
        M = state_matrix(p, network, state).astype(np.float32)
        y[:] = y + np.float32(dt) * np.linalg.solve(M, right)
    return truncated(system, dt, DONE, steps, run)
