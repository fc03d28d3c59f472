"""Minima of an attraction in the free space: descents that rest elsewhere than at their goal.

The sum k/2 |X - X_g|^2 + w k/2 |q - q_g|^2 of a position and a joint term is not convex in q.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy

from ...scene import PlacedArm
from ..field.potentials import JointAttraction, PositionAttraction, Potential, Sum


class FreeMinima(NamedTuple):
    """How many descents ended elsewhere than at the goal, and of these in a minimum."""

    elsewhere: int
    minima: int


def descend(field: Potential, start: np.ndarray) -> np.ndarray:
    """End (nq,) of a quasi-Newton descent of U(q), restarted until it no longer moves [rad]."""
    q = start
    for _ in range(5):
        found = scipy.optimize.minimize(
            field.value, q, jac=field.gradient, method="BFGS", options={"gtol": 1e-10}
        )
        if np.abs(found.x - q).max() < 1e-6:
            break
        q = found.x
    return found.x


def free_minima(
    placed: PlacedArm,
    gain: float,
    weight: float,
    pairs: int,
    rng: np.random.Generator,
    *,
    arrived: float,
    flat: float,
) -> FreeMinima:
    """Descents from random starts to random goals, joints uniform within the limits.

    Parameters
    ----------
    gain, weight : float
        k, and w [m^2/rad^2].
    arrived : float
        Largest joint error at the goal [rad].
    flat : float
        |dU/dq| up to which a descent has ended in a minimum.
    """
    elsewhere = minima = 0
    arm = placed.arm
    for start, goal in zip(*(arm.random_configurations(pairs, rng) for _ in range(2)), strict=True):
        position = PositionAttraction(placed, arm.positions(goal), gain)
        field = Sum((position, JointAttraction(goal, gain * weight)))
        end = descend(field, start)
        if np.abs(end - goal).max() > arrived:
            elsewhere += 1
            minima += bool(np.linalg.norm(field.gradient(end)) <= flat)
    return FreeMinima(elsewhere, minima)
