"""Quadratic programmes of the frozen crossing, on which solvers and equations are tried."""

from __future__ import annotations

from ...control.problem import QuadraticProgram
from ...control.recorded import recorded_problems
from ...control.settings import ControllerSettings
from ...control.solvers import solve
from ...tracking import memo
from .document import COARSE_STEP, CONTROL_STEP, frozen, run


@memo()
def recorded(every: int, dt: float = CONTROL_STEP) -> list[QuadraticProgram]:
    """Each ``every``-th problem of the frozen crossing in steps of ``dt`` [s]."""
    scenario, settings = frozen("crossing"), ControllerSettings()
    motion = run(scenario, settings, dt)
    return recorded_problems(scenario.system, scenario.circles, motion, settings, every)


@memo()
def busiest(count: int) -> list[QuadraticProgram]:
    """So many problems in a row, 5 ms apart, about the one where avoidance presses most."""
    problems = recorded(5)
    middle = max(range(len(problems)), key=lambda k: _pressure(problems[k]))
    start = min(max(middle - count // 2, 0), len(problems) - count)
    return problems[start : start + count]


@memo()
def sample_problem() -> QuadraticProgram:
    """The problem of the frozen task with the largest multiplier of an avoidance row."""
    return max(recorded(20, COARSE_STEP), key=_pressure)


def _pressure(p: QuadraticProgram) -> float:
    """Largest multiplier of an avoidance row."""
    return float(solve(p).z.max(initial=0.0))
