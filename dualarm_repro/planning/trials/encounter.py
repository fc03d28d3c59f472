"""What two motions over one index show: tips that meet, points near obstacles, openings passed."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...scene import JointPath, PlacedArm
from ..field.control_points import control_points, end_effector, ends_of
from ..field.obstacles import Obstacles
from ..plan import Plan
from ..settings import PointSet


def instants(plan: Plan, track: JointPath) -> np.ndarray:
    """Steps 0, 1, ... until the arm that is planned and the one on the track both rest (T,)."""
    return np.arange(1 + max(plan.steps, int(np.ceil(track.index[-1]))))


def tips_apart(
    plan: Plan, other: PlacedArm, track: JointPath, *, moving: bool = False
) -> np.ndarray:
    """Distance of the end effectors of two arms at every instant (T,) [m].

    Parameters
    ----------
    track
        Joint path of the other arm over the steps of the plan.
    moving
        Only while the arm that is planned is on its way; one that waits at its goal has no track.
    """
    times = instants(plan, track)[: plan.steps + 1 if moving else None]
    mine = plan.tcp[np.minimum(times, plan.steps)]
    return np.linalg.norm(mine - end_effector(other, track.at(times)), axis=1)


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
