"""The problem at each instant: the method and its steps, velocities, the quadratic programme."""

from . import method, program, velocities

__all__ = ["method", "program", "velocities"]
