"""Creases of a distance: places outside a shape where the direction away from it jumps.

The distance to a convex set is smooth outside it, with grad d Lipschitz: over a way s at a distance
of at least d it turns by no more than s / d. A set that is not convex has points with two nearest
ones, and across them the gradient jumps (F. H. Clarke, R. J. Stern, P. R. Wolenski, Proximal
smoothness and the lower-C2 property, J. Convex Analysis 2, 1995).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...scene.points import point_capsule
from ..field.hull_obstacle import point_hull

Point = tuple[float, float, float]
#: Gives the distance of a point and its gradient.
Distance = Callable[[Point], tuple[float, Point]]


def to_capsules(cores: np.ndarray, radii: np.ndarray) -> Distance:
    """Distance to the union of capsules with cores (C, 2, 3) [m]."""
    links = [(tuple(a), tuple(b - a), float(r)) for (a, b), r in zip(cores, radii, strict=True)]
    return lambda p: min((point_capsule(p, *link) for link in links), key=lambda found: found[0])


def to_hull(planes: np.ndarray, triangles: np.ndarray) -> Distance:
    """Distance to the hull with planes (F, 4) and triangles (F, 3, 3) [m]."""
    return lambda p: point_hull(p, planes, triangles)


def largest_turn(distance: Distance, line: np.ndarray, least: float) -> float:
    """Largest angle between the gradients at neighbours of a line (N, 3), where both are at least
    ``least`` [m] away [rad]."""
    found = [distance((float(x), float(y), float(z))) for x, y, z in line]
    away = np.array([d >= least for d, _ in found])
    directions = np.array([direction for _, direction in found])
    cosines = np.clip((directions[1:] * directions[:-1]).sum(axis=1), -1.0, 1.0)
    return float(np.arccos(cosines[away[1:] & away[:-1]]).max(initial=0.0))
