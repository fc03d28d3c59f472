"""What one answer of each solver costs, counted in instrumented runs."""

from __future__ import annotations

import numpy as np

from ..instrument import Cost, Instrument
from ..kernel import kernel
from .assembly import make_buffers, sense, state
from .certificate import residual
from .circle import Circles, follow
from .least_distance import least_distance
from .least_norm import least_norm
from .neural.network import network_rate, state_rate
from .neural.network_settings import NetworkSettings
from .neural.primal_dual import iterate
from .problem import QuadraticProgram
from .settings import ControllerSettings
from .singular_values import least_norm_by_singular_values
from .solvers import solve
from .system import ArmSystem
from .warm_start import least_distance_from

_PRESSES = 1e-9  # multiplier from which on a constraint presses


@kernel
def exact_step(arrays, numbers, q, home, position, velocity, buffers):
    """One step with every distance and the dual method from nothing, so at its dearest.

    What :func:`.step.control_step` leaves out depends on where the arms are.
    """
    count = sense(arrays, numbers, q, np.empty(0), buffers)
    program = state(arrays, numbers, q, home, position, velocity, count, buffers)
    status, x, y, z, w = least_distance(program)
    return status, len(program.h), residual(program, x, y, z, w), x


def exact_cost(p: QuadraticProgram) -> Cost:
    """The dual active-set method from nothing to the minimiser."""
    return Instrument().cost(least_distance, p.parts)


def exact_cost_after(p: QuadraticProgram, before: QuadraticProgram) -> Cost:
    """The same from the constraints that press in the problem before; anew where rows differ."""
    old = solve(before)
    if len(old.z) != len(p.h):
        return exact_cost(p)
    at_bound = np.sign(np.where(np.abs(old.w) > _PRESSES, old.w, 0.0)).astype(np.int64)
    return Instrument().cost(least_distance_from, p.parts, old.z > _PRESSES, at_bound)


def pseudo_inverse_cost(p: QuadraticProgram, *, singular_values: bool = False) -> Cost:
    """J^+ dr/dt by the Cholesky factor of J J^T, or by singular values as libraries do."""
    x, multipliers = np.empty(p.size), np.empty(len(p.b))
    if singular_values:
        return Instrument().cost(least_norm_by_singular_values, p.target, p.A, p.b, x)
    return Instrument().cost(least_norm, p.target, p.A, p.b, x, multipliers)


def network_cost(p: QuadraticProgram, network: NetworkSettings) -> Cost:
    """One evaluation of the state derivative at zero, with the step that follows."""
    size = p.size + len(p.b)
    y, rate, still = np.zeros(size), np.empty(size), np.zeros(size)
    rest = Instrument().cost(network_rate, network.numbers(), 1.0, still, p.parts, y, rate)
    return Cost(rest.operations + size, rest.functions)


def primal_dual_cost(p: QuadraticProgram) -> Cost:
    """One iteration of the primal-dual network."""
    return Instrument().cost(iterate, p.parts, np.zeros(p.size + len(p.b) + len(p.h)), 1, 0.0)


def control_cost(
    system: ArmSystem,
    circles: Circles,
    home: np.ndarray,
    settings: ControllerSettings,
    q: np.ndarray,
    t: float,
) -> Cost:
    """One whole step of the exact controller: kinematics, distances, rows, minimiser, check."""
    numbers = settings.numbers()
    buffers = make_buffers(system.arrays, numbers)
    position, velocity = np.empty((2, len(system.arms), 3))
    follow(circles.numbers(), t, position, velocity)
    state = (np.ascontiguousarray(q), home, position, velocity)
    return Instrument().cost(exact_step, system.arrays, numbers, *state, buffers)


def network_control_cost(
    system: ArmSystem,
    circles: Circles,
    home: np.ndarray,
    settings: ControllerSettings,
    network: NetworkSettings,
    dt: float,
    q: np.ndarray,
    t: float,
    y: np.ndarray,
) -> Cost:
    """One whole step of the network at a fixed rate."""
    numbers = settings.numbers()
    buffers = make_buffers(system.arrays, numbers)
    return Instrument().cost(
        state_rate,
        *(system.arrays, numbers, network.numbers(dt), circles.numbers()),
        *(np.ascontiguousarray(q), home, t, y, np.empty(0), np.zeros(len(y)), buffers),
        np.empty(len(y)),
    )
