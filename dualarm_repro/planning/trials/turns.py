"""When a plan turns to its virtual point and back, and whether the arm stood still before."""

from __future__ import annotations

import numpy as np

from ..plan import Plan

_ROUND = 1.0 + 1e-6


def phases(plan: Plan) -> list[bool]:
    """Whether the virtual point acts, phase by phase of a plan; neighbours differ."""
    changes = np.flatnonzero(np.diff(plan.active))
    return [bool(plan.active[0]), *(bool(plan.active[k + 1]) for k in changes)]


def onsets(plan: Plan) -> list[int]:
    """Steps at which the virtual point is switched on."""
    before = np.concatenate([[False], plan.active[:-1]])
    return np.flatnonzero(plan.active & ~before).tolist()


def stands_still(plan: Plan, step: int, block: int, threshold: float) -> bool:
    """Whether the mean configurations of the two blocks of steps before differ by less.

    Parameters
    ----------
    block
        Steps over which a mean is taken.
    threshold
        Largest difference of a joint [rad].
    """
    if step < 2 * block - 1:
        return False
    last, before = plan.path[step - block + 1 : step + 1], plan.path[: step - block + 1][-block:]
    return bool(abs(last.mean(axis=0) - before.mean(axis=0)).max() < _ROUND * threshold)
