"""The solvers compared: operations until they are near, and the motions they make."""

from . import motion, speed

__all__ = ["motion", "speed"]
