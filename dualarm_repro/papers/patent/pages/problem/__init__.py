"""The problem at each instant: the method and its steps, velocities, the quadratic programme."""

from . import energy, method, program, velocities

__all__ = ["energy", "method", "program", "velocities"]
