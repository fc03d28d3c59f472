"""Velocity control of arms that share a workspace: problem, solvers, networks, closed loop."""

from .circle import Circles, TimeLaw
from .controller import VelocityController
from .link_capsules import sticking_out, with_capsules
from .motion import Motion
from .neural.activation import Activation
from .neural.continuous import integrate_network
from .neural.fixed_step import simulate_network
from .neural.network_settings import FeedForward, NetworkSettings
from .neural.penalty import Penalty
from .neural.primal_dual import simulate_primal_dual
from .problem import NoSolution, QuadraticProgram, Solution
from .recorded import recorded_problems
from .scenario import Scenario, load_scenario
from .settings import ControllerSettings, Damper, PairSelection, RowForm
from .simulate import pseudo_inverse, simulate
from .solvers import OPTIONAL_SOLVERS, SOLVERS, solve
from .system import ArmSystem

__all__ = [
    "OPTIONAL_SOLVERS",
    "SOLVERS",
    "Activation",
    "ArmSystem",
    "Circles",
    "ControllerSettings",
    "Damper",
    "FeedForward",
    "Motion",
    "NetworkSettings",
    "NoSolution",
    "PairSelection",
    "Penalty",
    "QuadraticProgram",
    "RowForm",
    "Scenario",
    "Solution",
    "TimeLaw",
    "VelocityController",
    "integrate_network",
    "load_scenario",
    "pseudo_inverse",
    "recorded_problems",
    "simulate",
    "simulate_network",
    "simulate_primal_dual",
    "solve",
    "sticking_out",
    "with_capsules",
]
