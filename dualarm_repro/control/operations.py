"""What one answer of each solver costs, in operations counted by instrumented runs."""

from __future__ import annotations

import numpy as np

from .assembly import make_buffers
from .circle import Circles, follow
from .controller import control_step
from .instrument import Instrument
from .least_distance import least_distance
from .neural.network import network_rate, state_rate
from .neural.network_settings import NetworkSettings
from .neural.primal_dual import iterate
from .neural.saddle import solve_saddle
from .problem import Problem
from .settings import ROWS, Settings
from .system import ArmSystem


def exact_operations(p: Problem, function_cost: float = 1.0) -> float:
    """The dual active-set method from nothing to the minimiser."""
    return Instrument().count(least_distance, *p.parts, function_cost=function_cost)


def pseudo_inverse_operations(p: Problem) -> float:
    """J^+ dr/dt by the Cholesky factor of J J^T, as the saddle point with the identity."""
    return Instrument().count(
        solve_saddle, np.eye(p.size), p.A.copy(), np.concatenate([p.target, p.b])
    )


def network_operations(p: Problem, network: NetworkSettings, function_cost: float = 1.0) -> float:
    """One evaluation of the state derivative at zero, with the step that follows."""
    size = p.size + len(p.b)
    y, rate, still = np.zeros(size), np.empty(size), np.zeros(size)
    arguments = (network.numbers(), 1.0, still, *p.parts, y, rate)
    return Instrument().count(network_rate, *arguments, function_cost=function_cost) + size


def primal_dual_operations(p: Problem) -> float:
    """One iteration of the earlier network."""
    return Instrument().count(iterate, *p.parts, np.zeros(p.size + len(p.b) + len(p.h)), 1, 0.0)


def control_operations(
    system: ArmSystem,
    circles: Circles,
    home: np.ndarray,
    settings: Settings,
    q: np.ndarray,
    t: float,
) -> float:
    """One whole step of the exact controller: kinematics, distances, rows, minimiser, check."""
    numbers = settings.numbers()
    buffers = make_buffers(system.arrays, ROWS[numbers.form])
    position, velocity = np.empty((2, len(system.arms), 3))
    follow(circles.numbers(), t, position, velocity)
    state = (np.ascontiguousarray(q), home, position, velocity)
    return Instrument().count(control_step, system.arrays, numbers, *state, buffers)


def network_control_operations(
    system: ArmSystem,
    circles: Circles,
    home: np.ndarray,
    settings: Settings,
    network: NetworkSettings,
    dt: float,
    q: np.ndarray,
    t: float,
    y: np.ndarray,
) -> float:
    """One whole step of the network at a fixed rate."""
    numbers = settings.numbers()
    buffers = make_buffers(system.arrays, ROWS[numbers.form])
    return Instrument().count(
        state_rate,
        *(system.arrays, numbers, network.numbers(dt), circles.numbers()),
        *(np.ascontiguousarray(q), home, t, y, np.empty(0), np.zeros(len(y)), buffers),
        np.empty(len(y)),
    )
