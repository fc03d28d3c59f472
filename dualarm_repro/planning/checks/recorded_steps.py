"""Steps that a search has recorded, computed again one by one by the readable terms."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..search.bidirectional import resultant_at, surroundings_at
from ..search.search_plan import SearchPlan

#: Gains of the control points (K,) from the factors (K,) and the initial gain.
Gains = Callable[[np.ndarray, float], np.ndarray]


def step_difference(
    plan: SearchPlan, side: int, gains: Gains = lambda factor, initial: factor * initial
) -> float:
    """Largest difference of a step of half ``side`` to alpha F / |F| [rad].

    F is the resultant with the end of the other half, or the goal of a one-sided search, for its
    goal, and alpha the length of the step that was made. Infinity where ``gains`` gives no gains.
    """
    made, half = plan.problem, plan.record.paths[side]
    both = len(plan.record.paths) > 1
    other = plan.record.paths[1 - side] if both else np.tile(made.goal, (len(half), 1))
    late = int(side == 1 and made.settings.order == "after")
    worst = 0.0
    for k in range(plan.searches):
        chosen = gains(plan.record.factors[side][k], made.settings.repulsion.gain)
        if np.shape(chosen) != np.shape(plan.record.factors[side][k]):
            return float("inf")
        found = surroundings_at(made, side, half[k], k)
        force = resultant_at(made, found, half[k], other[k + late], chosen)
        step = half[k + 1] - half[k]
        expected = np.linalg.norm(step) * force / np.linalg.norm(force)
        worst = max(worst, float(np.abs(step - expected).max()))
    return worst if np.isfinite(worst) else float("inf")
