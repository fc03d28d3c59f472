"""Readings of `qiu` with everything that is open drawn anew from its plausible values."""

from __future__ import annotations

from typing import Any

import numpy as np

from ....ledger import REGISTRY

#: What is open about a search of the master from its start to a goal.
OPEN = (
    "goal_branch",
    "goal_wrist",
    "attraction_form",
    "repulsion_sources",
    "control_points",
    "gain_ratio",
    "gain_rule",
    "kappa",
    "delta_rho",
    "flip_rule",
    "adaptive_step",
    "step_floor",
    "weights",
    "joint_tolerance",
    "update_order",
    "floor",
    "limits",
)


def drawn(names: tuple[str, ...], rng: np.random.Generator) -> dict[str, Any]:
    """A plausible value of each assumption, drawn in this order."""
    fields = ("value", "range", "scale", "choices")
    return {key: REGISTRY.declared(f"qiu.{key}", *fields).at(rng.random()) for key in names}
