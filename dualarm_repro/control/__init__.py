"""Velocity-level control of arms that share a workspace: problem, exact solvers, closed loop."""

from .controller import VelocityController
from .settings import ControllerSettings
from .system import ArmSystem

__all__ = ["ArmSystem", "ControllerSettings", "VelocityController"]
