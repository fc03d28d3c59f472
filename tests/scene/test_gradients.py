import numpy as np
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import (
    JointPath,
    PlacedArm,
    Scene,
    clearance,
    clearance_gradient,
    distances,
)
from examples import central_difference, two_arms


@pytest.fixture(scope="module")
def scene():
    return two_arms(floor=0.1)


def numeric(scene, q, time=0.0):
    return central_difference(lambda x: distances(scene, x, time), q)


def test_random_configurations_apart_and_in_penetration(scene):
    rng = np.random.default_rng(0)
    q = rng.uniform(-1.5, 1.5, (60, 12))
    found, gradient = clearance_gradient(scene, q)
    assert gradient.shape == (60, len(scene.pairs), 12)
    for n in range(len(q)):
        np.testing.assert_allclose(gradient[n], numeric(scene, q[n]), atol=1e-6)
    for sort in ("capsule", "box", "plane", "hull"):
        of_sort = [k for k, (_, b) in enumerate(scene.pairs.bodies) if b.sort == sort]
        assert found.distance[:, of_sort].min() < -0.01
        assert found.distance[:, of_sort].max() > 0.01


def test_single_configuration(scene):
    q = np.random.default_rng(1).uniform(-1, 1, 12)
    found, gradient = clearance_gradient(scene, q)
    many, gradients = clearance_gradient(scene, q[None])
    np.testing.assert_allclose(gradient, gradients[0], atol=1e-14)
    np.testing.assert_allclose(found.distance, many.distance[0], atol=1e-14)
    np.testing.assert_allclose(found.distance, clearance(scene, q).distance, atol=1e-14)


def contact_between(scene, pair, start, end, level=0.0):
    """Configuration on the way from start to end at which one distance passes a level."""
    q = start + np.linspace(0, 1, 100)[:, None] * (end - start)
    d = distances(scene, q)[:, pair] - level
    k = np.flatnonzero(d[:-1] * d[1:] < 0)
    if not len(k):
        return None
    low, high = q[k[0]], q[k[0] + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        same = (distances(scene, middle)[pair] - level) * (distances(scene, low)[pair] - level) > 0
        low, high = (middle, high) if same else (low, middle)
    return low


@pytest.mark.parametrize("level", [0.0, -0.02])
@pytest.mark.parametrize("sort", ["capsule", "box", "plane", "hull"])
def test_touching_and_shallow_penetration(scene, sort, level):
    """At d = 0 and d = -2 cm exactly, from both sides."""
    rng = np.random.default_rng(2)
    of_sort = [k for k, (_, b) in enumerate(scene.pairs.bodies) if b.sort == sort]
    tested = 0
    while tested < 8:
        pair = rng.choice(of_sort)
        q = contact_between(scene, pair, *rng.uniform(-1.5, 1.5, (2, 12)), level)
        if q is None:
            continue
        found, gradient = clearance_gradient(scene, q)
        assert found.distance[pair] == pytest.approx(level, abs=1e-12)
        np.testing.assert_allclose(gradient[pair], numeric(scene, q)[pair], atol=1e-6)
        assert np.abs(gradient[pair]).max() > 1e-3
        tested += 1


@pytest.mark.parametrize("sort", ["box", "hull"])
def test_deep_penetration_with_the_core_inside(scene, sort):
    rng = np.random.default_rng(3)
    of_sort = [k for k, (_, b) in enumerate(scene.pairs.bodies) if b.sort == sort]
    radius = scene.bodies.radius[[scene.pairs.bodies[k][0].row for k in of_sort]]
    q = rng.uniform(-1.5, 1.5, (1000, 12))
    deep = distances(scene, q)[:, of_sort] < -radius - 0.005
    cases = np.argwhere(deep)[:40]
    assert len(cases) == 40
    for n, k in cases:
        _, gradient = clearance_gradient(scene, q[n])
        pair = of_sort[k]
        np.testing.assert_allclose(gradient[pair], numeric(scene, q[n])[pair], atol=1e-6)


def test_where_the_nearest_pair_switches_the_minimum_has_one_sided_derivatives(scene):
    """min_k d_k: to either side the slope of the pair that is nearest there, and they differ."""
    rng = np.random.default_rng(4)
    tested = 0
    while tested < 5:
        start, end = rng.uniform(-1, 1, (2, 12))
        q = start + np.linspace(0, 1, 300)[:, None] * (end - start)
        nearest = clearance(scene, q).nearest
        switches = np.flatnonzero(nearest[:-1] != nearest[1:])
        if not len(switches):
            continue
        k = switches[0]
        one, other = nearest[k], nearest[k + 1]
        low, high = q[k], q[k + 1]
        for _ in range(60):
            middle = 0.5 * (low + high)
            d = distances(scene, middle)
            low, high = (middle, high) if d[one] < d[other] else (low, middle)
        found, gradient = clearance_gradient(scene, low)
        if set(np.argsort(found.distance)[:2]) != {one, other}:
            continue
        assert found.distance[one] == pytest.approx(found.distance[other], abs=1e-12)
        direction = (end - start) / np.linalg.norm(end - start)
        step = 1e-6
        slopes = gradient[[one, other]] @ direction
        here = found.minimum
        ahead = (clearance(scene, low + step * direction).minimum - here) / step
        behind = (here - clearance(scene, low - step * direction).minimum) / step
        assert ahead == pytest.approx(slopes.min(), abs=1e-5)
        assert behind == pytest.approx(slopes.max(), abs=1e-5)
        tested += 1


def test_gradient_of_a_replayed_scene_moves_only_the_controlled_arm(scene):
    rng = np.random.default_rng(5)
    replay = scene.replaying("right", JointPath(rng.uniform(-1, 1, (3, 6))))
    q = rng.uniform(-1, 1, 6)
    _, gradient = clearance_gradient(replay, q, 0.7)
    np.testing.assert_allclose(gradient, numeric(replay, q, 0.7), atol=1e-6)


@pytest.mark.parametrize("name", ["panda", "es165d-slave"])
def test_self_pairs_of_other_arms(name):
    arm = load_arm(name)
    scene = Scene([PlacedArm("arm", arm)], floor=-2.0)
    q = arm.random_configurations(10, np.random.default_rng(6))
    _, gradient = clearance_gradient(scene, q)
    for n in range(len(q)):
        np.testing.assert_allclose(gradient[n], numeric(scene, q[n]), atol=1e-6)


def test_a_step_against_the_gradient_brings_two_arms_closer(scene):
    q = np.random.default_rng(7).uniform(-0.5, 0.5, 12)
    found, gradient = clearance_gradient(scene, q)
    for k in np.flatnonzero(np.abs(gradient).max(axis=1) > 1e-2):
        moved = distances(scene, q - 1e-4 * gradient[k])[k]
        expected = -1e-4 * gradient[k] @ gradient[k]
        # the second order of a step of 1e-4
        assert moved - found.distance[k] == pytest.approx(expected, rel=0.05)
