"""All distances of an arm among 1 to 10 000 spheres."""

from __future__ import annotations

from collections.abc import Callable

import coal
import numpy as np
import pinocchio as pin
from growth import Series
from robots import NAME

from dualarm_repro import load_arm
from dualarm_repro.scene import PlacedArm, Scene, Sphere, distances

TITLE, X = "distances of every link from every obstacle, 100 configurations", "obstacles"
SIZES = tuple(10**k for k in range(5))
RADIUS, CONFIGURATIONS = 0.02, 100  # [m, 1]


def series() -> list[Series]:
    """Ours, and the loop over pairs that Pinocchio runs in C++; both give the same distances."""
    return [
        Series("dualarm_repro", _ours, SIZES),
        Series("pin.computeDistances", _peer, SIZES[:4]),  # its model of 10 000 takes minutes
    ]


def _centres(count: int) -> np.ndarray:
    return np.random.default_rng(0).uniform(-1.0, 1.0, (count, 3))


def scene_of(count: int) -> Scene:
    """The arm on its base among ``count`` spheres; its own links are not watched."""
    balls = {f"ball{k}": Sphere(c, RADIUS) for k, c in enumerate(_centres(count))}
    return Scene([PlacedArm("arm", load_arm(NAME))], balls, self_collision=False)


def postures(count: int) -> np.ndarray:
    """Configurations of the arm, drawn with a seed."""
    return load_arm(NAME).random_configurations(CONFIGURATIONS, np.random.default_rng(count))


def _ours(count: int) -> Callable[[], object]:
    scene, q = scene_of(count), postures(count)
    return lambda: distances(scene, q)


def _peer(count: int) -> Callable[[], object]:
    arm, q = load_arm(NAME), postures(count)
    geometry = arm.geometry.copy()
    links = [k for k, shape in enumerate(geometry.geometryObjects) if shape.parentJoint > 0]
    geometry.removeAllCollisionPairs()
    for k, centre in enumerate(_centres(count)):
        pose, ball = pin.SE3(np.eye(3), centre), coal.Sphere(RADIUS)
        number = geometry.addGeometryObject(pin.GeometryObject(f"ball{k}", 0, pose, ball))
        for link in links:
            geometry.addCollisionPair(pin.CollisionPair(link, number))
    data, shapes = arm.model.createData(), geometry.createData()

    def run() -> np.ndarray:
        found = np.empty((len(q), len(geometry.collisionPairs)))
        for row, posture in zip(found, q, strict=True):
            pin.computeDistances(arm.model, data, geometry, shapes, posture)
            row[:] = [one.min_distance for one in shapes.distanceResults]
        return found

    mine = distances(scene_of(count), q)
    np.testing.assert_allclose(np.sort(run()), np.sort(mine), atol=1e-6)

    def without_reading() -> None:
        for posture in q:
            pin.computeDistances(arm.model, data, geometry, shapes, posture)

    return without_reading
