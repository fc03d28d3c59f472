"""How smooth the paths of searches are, in joint space and in task space."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from ..search.search_plan import SearchPlan
from .path_measures import bending, until_rest


def moving_part(plan: SearchPlan) -> np.ndarray:
    """The path (N, nq) [rad] of a search, a failed one only as far as where it rests."""
    if plan.reached:
        return plan.path
    return plan.path[: until_rest(plan.path, plan.problem.settings.step.length) + 1]


def bending_of(
    plan: SearchPlan, smooth: Callable[[np.ndarray], np.ndarray], spacing: Mapping[str, float]
) -> dict[str, float]:
    """:func:`.path_measures.bending` of the moving part after smoothing, by space.

    Parameters
    ----------
    spacing
        Of the samples, ``joints`` [rad] and ``tip`` [m].
    """
    path = smooth(moving_part(plan))
    points = {"joints": path, "tip": plan.placed.arm.positions(path)}
    return {space: bending(points[space], step) for space, step in spacing.items()}
