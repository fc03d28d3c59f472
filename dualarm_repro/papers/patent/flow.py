"""The seven steps of the method, each with the code that carries it out."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ...control import assembly, least_distance
from ...control.neural import continuous, network, optimality, penalty


class Step(NamedTuple):
    """One step: part of the flow chart, what it does, and the function that does it."""

    part: str
    text: str
    code: Callable


STATEMENT, SOLUTION = "problem statement and indices", "conversion and solution"
#: In the order of [0040]-[0048].
STEPS = (
    Step(STATEMENT, "inverse kinematics at velocity level", assembly.sense),
    Step(STATEMENT, "indices: least energy, joint limits, mutual avoidance", assembly.state),
    Step(SOLUTION, "QP under equalities and inequalities", least_distance.least_distance),
    Step(SOLUTION, "penalty: QP under equalities only", penalty.penalty),
    Step(SOLUTION, "Lagrange: matrix equation E y = e", optimality.optimality),
    Step(SOLUTION, "neural network solves E y = e", network.state_rate),
    Step(SOLUTION, "integration gives the joint angles", continuous.integrate_network),
)


def place(code: Callable) -> str:
    """Module and name of a function within the package."""
    module = code.__module__.partition(".")[2]
    return f"{module}.{code.__name__}"
