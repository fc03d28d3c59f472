"""Document `patent`: mutual avoidance of two redundant arms by a QP and a neural solver."""

from . import (
    accuracy,
    avoidance,
    comparison,
    contest,
    derivation,
    diagrams,
    equations,
    errata,
    gain,
    network,
    penalties,
    program,
    random_task_claims,
    robust,
)

__all__ = [
    "accuracy",
    "avoidance",
    "comparison",
    "contest",
    "derivation",
    "diagrams",
    "equations",
    "errata",
    "gain",
    "network",
    "penalties",
    "program",
    "random_task_claims",
    "robust",
]
