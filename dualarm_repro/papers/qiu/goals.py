"""The fifteen goals around the master's goal: seeded draws, rejected for stated reasons."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...scene import distances
from .readings import master_arm, master_posture
from .scenario import GOALS, branch_posture, truth_scene

_MOST_DRAWS = 1000


@dataclass(frozen=True, eq=False)
class GoalSet:
    """Postures (n, 6) [rad] and points (n, 3) [m] of the goals, and why draws were rejected."""

    q: np.ndarray
    points: np.ndarray
    rejected: dict[str, int]


def draw_goals(values: Mapping[str, Any], seed: int, count: int = GOALS) -> GoalSet:
    """Uniform draws from the box of half width ``goal_set`` around the master's goal.

    A draw is rejected where no posture of the branch reaches it, where that is outside the joint
    limits, or where the arm touches something at it. The set is smaller than ``count`` where a
    thousand draws do not fill it.
    """
    arm = master_arm(values)
    scene = truth_scene([arm])
    centre = arm.arm.positions(master_posture(values)) @ arm.placement.rotation.T
    centre = centre + arm.placement.translation
    rng = np.random.default_rng(seed)
    rejected: Counter[str] = Counter({"beyond reach": 0, "outside limits": 0, "in contact": 0})
    postures, points = [], []
    for _ in range(_MOST_DRAWS):
        if len(postures) == count:
            break
        point = centre + values["goal_set"] * rng.uniform(-1.0, 1.0, 3)
        q = branch_posture(arm, point, values["goal_branch"], values["goal_wrist"])
        if q is None:
            rejected["beyond reach"] += 1
        elif not arm.arm.within_limits(q):
            rejected["outside limits"] += 1
        elif distances(scene, q).min() <= 0.0:
            rejected["in contact"] += 1
        else:
            postures.append(q)
            points.append(point)
    q, found = (np.array(rows).reshape(-1, n) for rows, n in ((postures, 6), (points, 3)))
    return GoalSet(q, found, dict(rejected))
