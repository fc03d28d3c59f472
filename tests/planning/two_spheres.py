"""A search problem of the tests: one arm, a floor, a box and two spheres between start and goal."""

import numpy as np
import pinocchio as pin

from dualarm_repro.arms import load_arm
from dualarm_repro.planning.field.obstacles import obstacles_of
from dualarm_repro.planning.search.bidirectional_settings import BidirectionalSettings
from dualarm_repro.scene import Box, HalfSpace, PlacedArm, Scene, Sphere

START = np.zeros(6)
GOAL = np.array([1.99, 0.52, -0.87, 0.0, 0.0, 0.0])


def placed_arm(placement=None):
    base = pin.SE3(pin.rpy.rpyToMatrix(0, 0, np.pi / 2), np.array([0.35, 0.0, 0.0]))
    return PlacedArm("arm", load_arm("irb120"), base if placement is None else placement * base)


def shapes():
    return {
        "near": Sphere([-0.1, 0.2, 0.75], 0.1),
        "far": Sphere([-0.1, -0.03, 0.95], 0.1),
        "block": Box([0.5, 0.6, 0.3], [0.1, 0.2, 0.2]),
        "table": HalfSpace([0, 0, 1], -0.2),
    }


def obstacles(placement=None):
    there = shapes()
    if placement is not None:
        there = {name: shape.moved(placement) for name, shape in there.items()}
    return obstacles_of(Scene([placed_arm(placement)], there))


def settings(**changes):
    chosen = {
        "attraction": {"gain": 1000.0, "threshold": 0.4},
        "repulsion": {"gain": 10.0, "influence": 0.4},
        "control_points": (3, 5, 7),
        "variable_gain": {"rule": "power"},
        "step": {"length": 0.05, "rule": "saturating", "weights": (1, 2, 3)},
        "ending": {"tolerance": 0.05, "search_limit": 200, "stuck_searches": 40},
    }
    for key, value in changes.items():
        merge = isinstance(value, dict) and key in chosen
        chosen[key] = {**chosen[key], **value} if merge else value
    return BidirectionalSettings(**chosen)


ONE_SIDED = {
    "two_sided": False,
    "variable_gain": {"rule": "constant"},
    "step": {"rule": "constant"},
}
