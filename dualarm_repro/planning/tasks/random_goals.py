"""Random goals of the flange around a point: seeded draws, rejected for stated reasons."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...scene import Scene, distances

_MOST_DRAWS = 1000


@dataclass(frozen=True, eq=False)
class GoalSet:
    """Postures (n, nq) [rad] and points (n, 3) [m] of the goals, and why draws were rejected."""

    q: np.ndarray
    points: np.ndarray
    rejected: dict[str, int]


def draw_goals(
    scene: Scene,
    posture: Callable[[np.ndarray], np.ndarray | None],
    centre: ArrayLike,
    half_width: float,
    count: int,
    rng: np.random.Generator,
) -> GoalSet:
    """Uniform draws from a box around ``centre`` (3,) [m] for the one arm of a scene.

    A draw is rejected where ``posture`` gives no configuration that reaches it, where that is
    outside the joint limits, or where the arm touches something at it. The set is smaller than
    ``count`` where a thousand draws do not fill it.
    """
    arm = scene.arms[0].arm
    rejected: Counter[str] = Counter({"beyond reach": 0, "outside limits": 0, "in contact": 0})
    postures: list[np.ndarray] = []
    points: list[np.ndarray] = []
    for _ in range(_MOST_DRAWS):
        if len(postures) == count:
            break
        point = np.asarray(centre) + half_width * rng.uniform(-1.0, 1.0, 3)
        q = posture(point)
        if q is None:
            rejected["beyond reach"] += 1
        elif not arm.within_limits(q):
            rejected["outside limits"] += 1
        elif distances(scene, q).min() <= 0.0:
            rejected["in contact"] += 1
        else:
            postures.append(q)
            points.append(point)
    q, found = (np.array(rows).reshape(-1, n) for rows, n in ((postures, arm.nq), (points, 3)))
    return GoalSet(q, found, dict(rejected))
