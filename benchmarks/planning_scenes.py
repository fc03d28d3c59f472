"""Scenes of capsules and spheres in which edges and paths are timed, and tasks in them."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import PlacedArm, Scene, Sphere, distances
from dualarm_repro.scene.edges import free_edges

MARGIN = 0.005  # [m]
_CLEAR = 0.02  # of the ends of a task [m]


def one_arm() -> Scene:
    """An IRB 120 among two spheres."""
    balls = {"first": Sphere([0.35, 0.1, 0.5], 0.08), "second": Sphere([0.3, -0.25, 0.4], 0.07)}
    return Scene([PlacedArm("a", load_arm("irb120"))], balls)


def two_arms() -> Scene:
    """Two of them face to face, 12 joints, with two spheres between them."""
    arm = load_arm("irb120")
    turned = pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, np.pi), np.array([0.4, 0.0, 0.0]))
    facing = PlacedArm("a", arm, pin.SE3(np.eye(3), np.array([-0.4, 0.0, 0.0])))
    between = {"first": Sphere([0.0, 0.1, 0.6], 0.05), "second": Sphere([0.0, -0.25, 0.4], 0.06)}
    return Scene([facing, PlacedArm("b", arm, turned)], between)


def blocked_tasks(scene: Scene, count: int, in_turn: bool = False) -> list[tuple]:
    """Starts and goals (nq,) [rad] that are clear and whose straight line is barred; ``in_turn``
    only such where the arms may stop on the way, all but the first ones still at their starts."""
    rng, found = np.random.default_rng(1), []
    lower, upper = scene.limits
    while len(found) < count:
        start, goal = rng.uniform(0.6 * lower, 0.6 * upper, (2, scene.nq))
        stops = [start, goal]
        if in_turn:
            for columns in scene.columns.values():
                stops.append(stops[-1].copy() if len(stops) > 2 else start.copy())
                stops[-1][columns] = goal[columns]
        clear = distances(scene, np.array(stops)).min() > _CLEAR
        if clear and not free_edges(scene, start[None], goal[None], MARGIN)[0]:
            found.append((start, goal))
    return found
