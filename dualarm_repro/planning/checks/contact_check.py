"""Whether a planned path is free in truth: whole links, obstacles, floor, arms, joint limits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...scene import Scene, densify, distances
from ...scene.bodies import Body
from ...scene.scene import FLOOR

ARMS, SELF, OBSTACLES = "arms", "self", "obstacles"
SAMPLING = 0.02


@dataclass(frozen=True)
class ContactCheck:
    """Smallest distances along a path that is linear between its samples.

    Attributes
    ----------
    clearance : dict
        ``obstacles``, ``floor``, ``arms`` (links of two arms) and ``self`` (links of one arm) to
        the smallest signed distance [m]; what the scene does not have is absent.
    beyond_limits : float
        Largest excess over a joint limit [rad]; 0 inside.
    """

    clearance: dict[str, float]
    beyond_limits: float

    @property
    def smallest(self) -> float:
        """Smallest distance of all [m]."""
        return min(self.clearance.values(), default=np.inf)

    @property
    def free(self) -> bool:
        """Whether nothing touches and all joints stay within their limits."""
        return self.smallest > 0.0 and self.beyond_limits <= 0.0


def contact_check(scene: Scene, path: np.ndarray, max_step: float = SAMPLING) -> ContactCheck:
    """Distances of all watched pairs on a path (N, nq of the scene) of all its controlled arms.

    Samples are inserted until no joint moves more than ``max_step`` [rad] between neighbours.
    """
    q, time = densify(path, max_step)
    smallest = distances(scene, q, time).min(axis=0)
    clearance: dict[str, float] = {}
    for pair, distance in zip(scene.pairs.bodies, smallest.tolist(), strict=True):
        group = _group(scene, *pair)
        clearance[group] = min(distance, clearance.get(group, np.inf))
    lower, upper = scene.limits
    excess = np.maximum(lower - path, path - upper).max()
    return ContactCheck(clearance, max(float(excess), 0.0))


def _group(scene: Scene, first: Body, second: Body) -> str:
    if first.owner == second.owner:
        return SELF
    if second.owner == FLOOR:
        return FLOOR
    arms = {*scene.columns, *(n for n, m in scene.moving.items() if hasattr(m, "arm"))}
    return ARMS if second.owner in arms else OBSTACLES
