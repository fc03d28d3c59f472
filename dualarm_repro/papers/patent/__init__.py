"""Document `patent`: mutual avoidance of two redundant arms by a QP and a neural solver."""

from . import (
    avoidance,
    comparison,
    contest,
    derivation,
    diagrams,
    errata,
    network,
    penalties,
    program,
    random_task_claims,
)

__all__ = [
    "avoidance",
    "comparison",
    "contest",
    "derivation",
    "diagrams",
    "errata",
    "network",
    "penalties",
    "program",
    "random_task_claims",
]
