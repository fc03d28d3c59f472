"""The seven steps of the method, each with the code that carries it out, and a traced run."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ...control import assembly, avoidance, kinematics
from ...control.neural import fixed_step, network, optimality, penalty
from ...control.neural.network_settings import NetworkSettings
from ...control.settings import ControllerSettings
from ...tracking import memo
from .constants import CONTROL_STEP
from .instrument import Instrument
from .scenario import frozen


class Step(NamedTuple):
    """One step: part of the flow chart, what it does, and the function whose return ends it."""

    part: str
    text: str
    code: Callable[..., Any]


STATEMENT, SOLUTION = "problem statement and indices", "conversion and solution"
STEPS = (
    Step(STATEMENT, "inverse kinematics at velocity level", kinematics.tip_jacobian),
    Step(STATEMENT, "indices of energy, joint limits and avoidance", avoidance.fill_rows),
    Step(SOLUTION, "QP under equalities and inequalities", assembly.state),
    Step(SOLUTION, "penalty to a QP under equalities only", penalty.penalty),
    Step(SOLUTION, "Lagrange to a matrix equation", optimality.optimality),
    Step(SOLUTION, "neural network solves it", network.state_rate),
    Step(SOLUTION, "integration to joint angles", fixed_step.run_network),
)


@memo()
def trace() -> tuple[str, ...]:
    """Names of the functions in the order of their returns in two ticks of the closed loop.

    The run starts inside the inner range, so that avoidance rows are present.
    """
    scenario, numbers = frozen("too_close"), ControllerSettings().numbers()
    system, instrument = scenario.system, Instrument()
    none, size = np.empty((0, 0)), scenario.system.nq + 3 * len(scenario.system.arms)
    instrument.twin(fixed_step.run_network)(
        *(system.arrays, numbers, NetworkSettings().numbers(CONTROL_STEP)),
        *(scenario.circles.numbers(), scenario.q0, np.zeros(size), 2, CONTROL_STEP),
        *(none, none),
    )
    return tuple(instrument.returned)


def traced_steps() -> list[Step]:
    """The steps that the run carries out, in the order in which it first ends them."""
    returned = trace()
    done = [step for step in STEPS if name(step) in returned]
    return sorted(done, key=lambda step: returned.index(name(step)))


def name(step: Step) -> str:
    """Name of the function of a step."""
    return step.code.__name__


def place(code: Callable[..., Any]) -> str:
    """Module and name of a function within the package."""
    module = code.__module__.partition(".")[2]
    return f"{module}.{code.__name__}"
