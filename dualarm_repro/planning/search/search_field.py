"""The repulsion of a search at a posture, with its constant gain: potential, torque, balance."""

from __future__ import annotations

import numpy as np

from ...scene import PlacedArm
from ..field.obstacles import Obstacles
from ..field.repulsive_force import inverse_distance_potential
from .bidirectional import repulsive_torque, surroundings_at
from .bidirectional_settings import BidirectionalSettings
from .search_problem import SearchProblem, search_problem


def repulsive_potential_at(made: SearchProblem, q: np.ndarray) -> float:
    """U_rep(q), summed over the control points and the shapes that repel them."""
    found, repulsion = surroundings_at(made, 0, q, 0), made.settings.repulsion
    values = inverse_distance_potential(found.distance, repulsion.gain, repulsion.influence)
    return float((values * found.acting(repulsion.sources)).sum())


def repulsive_torque_at(made: SearchProblem, q: np.ndarray) -> np.ndarray:
    """F_rep(q) = -grad U_rep(q) (nq,)."""
    gains = np.full(len(made.points.joint), made.settings.repulsion.gain)
    return repulsive_torque(made, surroundings_at(made, 0, q, 0), gains)


def balance_gain(
    placed: PlacedArm, q: np.ndarray, obstacles: Obstacles, threshold: float, influence: float
) -> float:
    """eta/zeta at which the repulsion of the flange is as large as the largest attraction.

    d zeta = |J^T F_rep| at the posture q (nq,), d the ``threshold`` of the attraction [rad] and
    ``influence`` the range of the repulsion [m]. Sizes are compared, not directions.
    """
    chosen = BidirectionalSettings(
        attraction={"gain": 1.0, "threshold": threshold},
        repulsion={"gain": 1.0, "influence": influence},
        control_points=(placed.arm.nq + 1,),
        step={"length": 1.0},
        ending={"tolerance": 1.0, "search_limit": 1, "stuck_searches": 1},
    )
    made = search_problem(placed, q, q, obstacles, chosen)
    return threshold / float(np.linalg.norm(repulsive_torque_at(made, q)))


def balance_distance(gain: float, influence: float, pull: float, lever: float) -> float:
    """Distance from an obstacle [m] at which the torque of one point's repulsion on a ``lever`` [m]
    is as large as a ``pull``, to the nearest of 100 001 distances from 1 cm to ``influence``."""
    rho = np.linspace(0.01, influence, 100_001)
    torque = lever * gain * (1.0 / rho - 1.0 / influence) / rho**2
    return float(rho[np.abs(torque - pull).argmin()])
