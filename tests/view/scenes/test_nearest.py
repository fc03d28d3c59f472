"""Distances shown in a scene are those that the library computes."""

import numpy as np
import pinocchio as pin

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import PlacedArm, Scene, Sphere, distances
from dualarm_repro.view.scenes.nearest import nearest_pairs


def placed(name, y):
    return PlacedArm(name, load_arm("irb120"), pin.SE3(np.eye(3), np.array([0.0, y, 0.0])))


def test_smallest_distance_and_its_ends():
    arms, ball = [placed("left", 0.0), placed("right", 0.7)], {"ball": Sphere([0.3, 0.2, 0.5], 0.1)}
    rng = np.random.default_rng(1)
    paths = {arm.name: (arm, arm.arm.random_configurations(40, rng)) for arm in arms}
    found = nearest_pairs(paths, ball)
    scene = Scene(arms, ball, self_collision=False)
    expected = distances(scene, np.hstack([path for _, path in paths.values()])).min(axis=1)
    np.testing.assert_allclose(found.distance, expected, atol=1e-12)
    gap = np.linalg.norm(found.ends[:, 1] - found.ends[:, 0], axis=1)
    np.testing.assert_allclose(gap, abs(expected), atol=1e-9)
    assert [bool(c) for c in found.contacts] == (expected <= 0.0).tolist()
    assert 0 < sum(map(bool, found.contacts)) < 40


def test_bodies_in_words():
    arm = placed("left", 0.0)
    found = nearest_pairs({"left": (arm, np.zeros((1, 6)))}, {"ball": Sphere([0.0, 0.5, 0.1], 0.1)})
    assert found.names[0][1] == "ball"
    assert found.names[0][0].startswith("left, link")


def test_nothing_to_measure():
    assert nearest_pairs({"left": (placed("left", 0.0), np.zeros((1, 6)))}, {}) is None
