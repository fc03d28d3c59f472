"""The repulsion of a search at a posture, with its constant gain: potential, torque, balance."""

from __future__ import annotations

import numpy as np

from ..field.repulsive_force import inverse_distance_potential
from .bidirectional import repulsive_torque, surroundings_at
from .search_problem import SearchProblem


def repulsive_potential_at(made: SearchProblem, q: np.ndarray) -> float:
    """U_rep(q), summed over the control points and the shapes that repel them."""
    found, repulsion = surroundings_at(made, 0, q, 0), made.settings.repulsion
    values = inverse_distance_potential(found.distance, repulsion.gain, repulsion.influence)
    return float((values * found.acting(repulsion.sources)).sum())


def repulsive_torque_at(made: SearchProblem, q: np.ndarray) -> np.ndarray:
    """F_rep(q) = -grad U_rep(q) (nq,)."""
    gains = np.full(len(made.points.joint), made.settings.repulsion.gain)
    return repulsive_torque(made, surroundings_at(made, 0, q, 0), gains)


def balance_distance(gain: float, influence: float, pull: float, lever: float) -> float:
    """Distance from an obstacle [m] at which the torque of one point's repulsion on a ``lever`` [m]
    is as large as a ``pull``, to the nearest of 100 001 distances from 1 cm to ``influence``."""
    rho = np.linspace(0.01, influence, 100_001)
    torque = lever * gain * (1.0 / rho - 1.0 / influence) / rho**2
    return float(rho[np.abs(torque - pull).argmin()])
