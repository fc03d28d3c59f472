"""The solvers compared: operations until they are near, and the motions they make."""

from . import motion, real_time, robust, speed

__all__ = ["motion", "real_time", "robust", "speed"]
