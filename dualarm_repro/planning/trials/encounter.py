"""What a motion shows: points near obstacles, openings passed."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..field.control_points import control_points, ends_of
from ..field.obstacles import Obstacles
from ..plan import Plan
from ..settings import PointSet


def to_obstacles(plan: Plan, points: PointSet, obstacles: Obstacles) -> np.ndarray:
    """Signed distance of every control point to the nearest obstacle along a plan (N, K) [m].

    Parameters
    ----------
    points
        Name of the set of control points.
    obstacles
        Where they are at step 0.
    """
    chosen = control_points(plan.placed.arm, points)
    ends = ends_of(plan.placed, chosen, plan.path)
    return obstacles.distances(ends, chosen.radius, 0)[0].min(axis=2)


def inside_opening(
    track: np.ndarray, centre: ArrayLike, facing: np.ndarray, size: ArrayLike
) -> float:
    """How far inside a rectangular opening a track (N, 3) crosses its plane [m].

    The smallest distance of a crossing to the edge, negative outside; minus infinity if the plane
    is not crossed.

    Parameters
    ----------
    facing : (3, 3)
        Columns along width, height and normal of the opening.
    size : (2,)
        Width and height [m].
    """
    inside = (track - np.asarray(centre)) @ facing
    crossing = np.flatnonzero(np.diff(np.sign(inside[:, 2])))
    if not len(crossing):
        return -np.inf
    return float((0.5 * np.asarray(size) - np.abs(inside[crossing, :2])).min())
