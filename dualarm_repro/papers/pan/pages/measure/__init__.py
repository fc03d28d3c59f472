"""Page `pan/measure`: how well three robots can move together."""

from . import kinematics, system

__all__ = ["kinematics", "system"]
