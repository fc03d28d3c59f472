"""What two motions in an arrangement show: meetings, distances, clearance of the links."""

from __future__ import annotations

import numpy as np

from ...planning.field.control_points import control_points, end_effector, ends_of
from ...planning.plan import Plan
from ...scene import JointPath, PlacedArm, facing
from .layout import Layout
from .motions import window_obstacles


def flange_to_window(plan: Plan, layout: Layout) -> np.ndarray:
    """Signed distance of the end effector to the nearest bar, (N,) [m]."""
    return _to_window(plan, layout, "end_effector")[:, 0]


def points_to_window(plan: Plan, layout: Layout, points: str) -> np.ndarray:
    """Signed distance of the nearest control point to the nearest bar, (N,) [m]."""
    return _to_window(plan, layout, points).min(axis=1)


def flanges_apart(slave: Plan, master: PlacedArm, track: JointPath) -> np.ndarray:
    """Distance of the two end effectors at each instant until both arms rest, (T,) [m]."""
    times = instants(slave, track)
    mine = slave.tcp[np.minimum(times, slave.steps)]
    return np.linalg.norm(mine - end_effector(master, track.at(times)), axis=1)


def flanges_apart_moving(slave: Plan, master: PlacedArm, track: JointPath) -> np.ndarray:
    """The same while the slave is on its way; one that waits at its goal has no track."""
    return flanges_apart(slave, master, track)[: slave.steps + 1]


def instants(slave: Plan, track: JointPath) -> np.ndarray:
    """Steps 0, 1, ... until both arms rest."""
    return np.arange(1 + max(slave.steps, int(np.ceil(track.index[-1]))))


def _to_window(plan: Plan, layout: Layout, points: str) -> np.ndarray:
    chosen = control_points(plan.placed.arm, points)
    ends = ends_of(plan.placed, chosen, plan.path)
    return window_obstacles(layout).distances(ends, chosen.radius, 0)[0].min(axis=2)


def through_window(plan: Plan, layout: Layout) -> float:
    """How far inside the opening the end effector crosses the plane of the window [m].

    The smallest distance of a crossing to the edge of the opening, negative outside it; minus
    infinity without a crossing.
    """
    inside = (plan.tcp - layout.window_centre) @ facing(layout.normal)
    half = 0.5 * np.array([layout.window_opening_width, layout.window_opening_height])
    crossing = np.flatnonzero(np.diff(np.sign(inside[:, 2])))
    return float((half - np.abs(inside[crossing, :2])).min()) if len(crossing) else -np.inf
