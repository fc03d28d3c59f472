"""Document `pan`: where to start a weld with three robots, by manipulability and evolution."""

from . import (
    bases,
    consistency,
    coordination,
    drawings,
    errata,
    evolution,
    geometry,
    measures,
    poor,
    result,
    sensitivity,
    studies,
    system_measure,
)

__all__ = [
    "bases",
    "consistency",
    "coordination",
    "drawings",
    "errata",
    "evolution",
    "geometry",
    "measures",
    "poor",
    "result",
    "sensitivity",
    "studies",
    "system_measure",
]
