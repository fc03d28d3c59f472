"""The model that other libraries get: the same bodies, pairs and distances as the scene."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.baselines.pinocchio_scene import whole_model
from dualarm_repro.scene import Box, JointPath, PlacedArm, Scene, Sphere, distances


@pytest.fixture(scope="module")
def scene():
    """A Panda and an IRB 120 turned by a third of a circle, and a parked one, among solids."""
    arm, other = load_arm("panda"), load_arm("irb120")
    turned = pin.SE3(pin.rpy.rpyToMatrix(0.1, 0.0, 2.0), np.array([0.8, 0.1, 0.2]))
    arms = [
        PlacedArm("left", arm, pin.SE3(np.eye(3), np.array([-0.4, 0.0, 0.0]))),
        PlacedArm("right", other, turned),
        PlacedArm("parked", other, pin.SE3(np.eye(3), np.array([0.0, 1.1, 0.0]))),
    ]
    bars = (Box([0.3, -0.6, 0.4], [0.1, 0.2, 0.3]), Box([0.5, -0.6, 0.9], [0.1, 0.1, 0.1]))
    whole = Scene(arms, {"ball": Sphere([0.1, 0.2, 0.8], 0.1), "bars": bars}, floor=-0.1)
    return whole.replaying("parked", JointPath([np.full(6, 0.3)]))


def test_distances_are_those_of_the_scene(scene):
    """Where bodies are apart, by coal and Pinocchio, pair by pair."""
    model, geometry = whole_model(scene)
    assert model.nq == scene.nq == 13
    assert len(geometry.collisionPairs) == len(scene.pairs)
    data, shapes = model.createData(), pin.GeometryData(geometry)
    rng = np.random.default_rng(3)
    for q in rng.uniform(-1.0, 1.0, (5, 13)):
        q = np.clip(q, *scene.limits)
        right = distances(scene, q)
        pin.computeDistances(model, data, geometry, shapes, q)
        found = np.array([one.min_distance for one in shapes.distanceResults])
        apart = right > 1e-3
        np.testing.assert_allclose(found[apart], right[apart], atol=1e-5)
        assert (found[~apart] < 2e-3).all()


def test_joints_keep_their_order_and_names(scene):
    model, _ = whole_model(scene)
    owners = [name.partition("/")[0] for name in list(model.names)[1:]]
    assert owners == ["left"] * 7 + ["right"] * 6
