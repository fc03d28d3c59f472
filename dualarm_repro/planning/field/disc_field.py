"""The field of a point in a plane that is drawn to a goal and pushed off a disc."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...differences import central_differences
from ..settings import Threshold
from .joint_attraction import conic_force, conic_potential
from .repulsive_force import inverse_distance_force, inverse_distance_potential

_CONTACT = 1e-3
_CLOSEST = 0.01  # of the levels drawn [m]


@dataclass(frozen=True, eq=False)
class DiscField:
    """Goal and centre of the disc (2,) [m], its radius [m]; gain zeta and threshold d [m] of the
    attraction, gain eta and range rho_0 [m] of the repulsion."""

    goal: np.ndarray
    centre: np.ndarray
    radius: float
    attraction: float
    threshold: float
    repulsion: float
    influence: float

    def potential(self, points: np.ndarray) -> np.ndarray:
        """U_att + U_rep of points (N, 2)."""
        rho = np.linalg.norm(points - self.centre, axis=1) - self.radius
        pull = [
            conic_potential(p, self.goal, self.attraction, self.threshold, Threshold.NORM)
            for p in points
        ]
        near = np.maximum(rho, _CLOSEST)
        return np.array(pull) + inverse_distance_potential(near, self.repulsion, self.influence)

    def forces(self, point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """F_att and F_rep (2,) at a point (2,)."""
        away = point - self.centre
        far = np.linalg.norm(away)
        rho = far - self.radius
        push = inverse_distance_force(rho, self.repulsion, self.influence, _CONTACT) * away / far
        pull = conic_force(point, self.goal, self.attraction, self.threshold, Threshold.NORM)
        return pull, push

    def imbalance(self, point: np.ndarray) -> float:
        """|F_att + F_rep + grad U| / |F_att| at a point (2,), by central differences."""
        pull, push = self.forces(point)
        slope = central_differences(lambda x: self.potential(x[np.newaxis])[0], point)
        return float(np.linalg.norm(pull + push + slope)) / float(np.linalg.norm(pull))
