"""What one answer of each solver costs, in operations counted by instrumented runs."""

from __future__ import annotations

import numpy as np

from ...control.assembly import make_buffers
from ...control.circle import follow
from ...control.controller import control_step
from ...control.least_distance import least_distance
from ...control.neural.network import network_rate, state_rate
from ...control.neural.network_settings import NetworkSettings
from ...control.neural.primal_dual import iterate
from ...control.neural.saddle import solve_saddle
from ...control.problem import QuadraticProgram
from ...control.recorded import recorded_problems
from ...control.settings import ControllerSettings
from ...control.solvers import solve
from ...tracking import memo
from .constants import CONTROL_STEP
from .instrument import Instrument
from .scenario import Frozen, frozen, run


@memo()
def recorded(every: int) -> list[QuadraticProgram]:
    """Each ``every``-th problem of the frozen crossing at 1 kHz."""
    scenario, settings = frozen("crossing"), ControllerSettings()
    return recorded_problems(
        scenario.system, scenario.circles, run(scenario, settings), settings, every
    )


@memo()
def busiest(count: int) -> list[QuadraticProgram]:
    """So many problems in a row, 5 ms apart, about the one where avoidance presses most."""
    problems = recorded(5)
    middle = max(range(len(problems)), key=lambda k: float(solve(problems[k]).z.max(initial=0.0)))
    start = min(max(middle - count // 2, 0), len(problems) - count)
    return problems[start : start + count]


def exact_operations(p: QuadraticProgram, function_cost: float = 1.0) -> float:
    """The dual active-set method from nothing to the minimiser."""
    return Instrument().count(least_distance, p.parts, function_cost=function_cost)


def pseudo_inverse_operations(p: QuadraticProgram) -> float:
    """J^+ dr/dt by the Cholesky factor of J J^T, as the saddle point with the identity."""
    return Instrument().count(
        solve_saddle, np.eye(p.size), p.A.copy(), np.concatenate([p.target, p.b])
    )


def network_operations(
    p: QuadraticProgram, network: NetworkSettings, function_cost: float = 1.0
) -> float:
    """One evaluation of the state derivative at zero, with the step that follows."""
    size = p.size + len(p.b)
    y, rate, still = np.zeros(size), np.empty(size), np.zeros(size)
    arguments = (network.numbers(), 1.0, still, p.parts, y, rate)
    return Instrument().count(network_rate, *arguments, function_cost=function_cost) + size


def primal_dual_operations(p: QuadraticProgram) -> float:
    """One iteration of the earlier network."""
    return Instrument().count(iterate, p.parts, np.zeros(p.size + len(p.b) + len(p.h)), 1, 0.0)


def control_operations(
    scenario: Frozen, settings: ControllerSettings, q: np.ndarray, t: float
) -> float:
    """One whole step of the exact controller: kinematics, distances, rows, minimiser, check."""
    system, numbers = scenario.system, settings.numbers()
    buffers = make_buffers(system.arrays, numbers)
    position, velocity = np.empty((2, len(system.arms), 3))
    follow(scenario.circles.numbers(), t, position, velocity)
    state = (np.ascontiguousarray(q), scenario.q0, position, velocity)
    return Instrument().count(control_step, system.arrays, numbers, *state, buffers)


def network_control_operations(
    scenario: Frozen, settings: ControllerSettings, q: np.ndarray, t: float, y: np.ndarray
) -> float:
    """One whole step of the network at a fixed rate."""
    system, numbers = scenario.system, settings.numbers()
    buffers, network = make_buffers(system.arrays, numbers), NetworkSettings()
    return Instrument().count(
        state_rate,
        *(system.arrays, numbers, network.numbers(CONTROL_STEP), scenario.circles.numbers()),
        *(np.ascontiguousarray(q), scenario.q0, t, y, np.empty(0), np.zeros(len(y)), buffers),
        np.empty(len(y)),
    )
