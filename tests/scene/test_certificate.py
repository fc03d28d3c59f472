import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import ConfigurationError, InputError
from dualarm_repro.scene import (
    Box,
    Capsule,
    ConvexHull,
    JointPath,
    MovingShape,
    PlacedArm,
    PosePath,
    Scene,
    Sphere,
    certified_minimum,
    clearance,
    densify,
    distances,
)
from dualarm_repro.scene.certificate import reach
from dualarm_repro.scene.posing import link_frames, links_of, place_cores
from examples import random_placement, seeds, thorough, two_arms


def check(scene, path, bracket, tolerance, index=None):
    q, time = densify(path, 2e-3, index)
    truth = clearance(scene, q, time).minimum.min()
    assert bracket.lower <= truth + 1e-12
    assert bracket.lower <= bracket.upper <= bracket.lower + tolerance
    assert truth >= bracket.upper - tolerance
    assert clearance(scene, bracket.q, bracket.time).minimum == pytest.approx(
        bracket.upper, abs=1e-12
    )


@given(seeds)
@settings(thorough, max_examples=10)
def test_bracket_holds_the_minimum_of_dense_samples(seed):
    rng = np.random.default_rng(seed)
    scene = two_arms(floor=-0.2)
    path = rng.uniform(-1.2, 1.2, (4, 12))
    check(scene, path, certified_minimum(scene, path, tolerance=1e-3), 1e-3)


def test_it_finds_a_minimum_between_the_samples():
    """The arm swings past a pole that both samples are far from."""
    arm = load_arm("irb120")
    scene = Scene([PlacedArm("arm", arm)], {"pole": Capsule((0.4, 0, 0), (0.4, 0, 1.5), 0.02)})
    path = np.array([[-1.0, 0, 0, 0, 0, 0], [1.0, 0, 0, 0, 0, 0]])
    assert clearance(scene, path).minimum.min() > 0.05
    bracket = certified_minimum(scene, path, tolerance=1e-4)
    assert bracket.upper < -0.02
    # in contact from before the middle until after it
    assert bracket.time == pytest.approx(0.5, abs=0.2)
    check(scene, path, bracket, 1e-4)


def test_fewer_configurations_prove_freedom_than_find_the_minimum():
    scene = two_arms(obstacles=False)
    rng = np.random.default_rng(0)
    path = rng.uniform(-0.4, 0.4, (6, 12))
    tight = certified_minimum(scene, path, tolerance=1e-5)
    assert tight.upper > 0.02
    free = certified_minimum(scene, path, tolerance=1e-5, enough=0.0)
    assert 0 <= free.lower <= tight.upper
    assert free.evaluations < tight.evaluations


def test_a_small_budget_gives_a_wider_bracket_that_is_still_true():
    scene = two_arms(floor=-0.2)
    path = np.random.default_rng(1).uniform(-1, 1, (3, 12))
    tight = certified_minimum(scene, path, tolerance=1e-4)
    rough = certified_minimum(scene, path, tolerance=1e-4, budget=10)
    assert rough.evaluations <= 10
    assert rough.lower <= tight.lower
    assert rough.upper >= tight.upper - 1e-12
    assert rough.upper - rough.lower > 1e-4


@given(seeds)
@settings(thorough, max_examples=10)
def test_moving_obstacles_are_bounded_too(seed):
    rng = np.random.default_rng(seed)
    base = two_arms(obstacles=False)
    shapes = [
        Sphere(0.2 * rng.normal(size=3), 0.1),
        Box(0.2 * rng.normal(size=3), (0.3, 0.2, 0.1), random_placement(rng).rotation),
        ConvexHull(0.2 * rng.normal(size=(8, 3))),
    ]
    near = pin.SE3(np.eye(3), np.array([0.0, 0.4, 0.5]))
    movers = {
        f"thing{k}": MovingShape(
            shape, PosePath([near * random_placement(rng, 0.3) for _ in range(3)], [0, 1.5, 4])
        )
        for k, shape in enumerate(shapes)
    }
    replayed = base.replaying("right", JointPath(rng.uniform(-1, 1, (4, 6))))
    scene = Scene(replayed.arms, {}, {**replayed.moving, **movers}, floor=-0.1)
    path, index = rng.uniform(-1, 1, (3, 6)), [0.5, 2, 3.5]
    check(scene, path, certified_minimum(scene, path, index, tolerance=2e-3), 2e-3, index)


def test_a_parked_path():
    scene = two_arms(obstacles=False)
    q = np.random.default_rng(2).uniform(-1, 1, (1, 12))
    bracket = certified_minimum(scene, q)
    assert bracket.lower == bracket.upper == pytest.approx(distances(scene, q).min(), abs=1e-14)
    assert bracket.evaluations == 1
    again = certified_minimum(scene, np.repeat(q, 2, axis=0))
    assert again.lower == pytest.approx(bracket.lower, abs=1e-12)


def test_nothing_watched_is_infinitely_clear():
    scene = Scene([PlacedArm("arm", load_arm("irb120"))], self_collision=False)
    bracket = certified_minimum(scene, np.zeros((2, 6)))
    assert bracket.lower == bracket.upper == np.inf


@pytest.mark.parametrize("name", ["irb120", "panda", "ur5"])
def test_reach_bounds_the_speed_of_every_core_point(name):
    """|dp/dq_j| <= reach, and for some configuration it is not far below."""
    rng = np.random.default_rng(3)
    arm = load_arm(name)
    links, bound = links_of(arm), reach(arm)
    q = arm.random_configurations(400, rng)
    fastest = np.zeros_like(bound)
    for j in range(arm.nq):
        ends = []
        for sign in (-1, 1):
            moved = q.copy()
            moved[:, j] += sign * 1e-6
            ends.append(np.empty((len(q), len(links.joint), 2, 3)))
            frames = link_frames(arm.chain, np.eye(3, 4), moved)
            place_cores(frames, links.joint, links.local, ends[-1], 0)
        speed = np.linalg.norm(ends[1] - ends[0], axis=-1) / 2e-6
        fastest[:, j] = speed.max(axis=(0, 2))
    assert (fastest <= bound + 1e-9).all()
    assert fastest[:, 0].max() > 0.5 * bound[:, 0].max()


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        (([[0.0] * 6],), ConfigurationError, "shape of q"),
        (([0.0] * 12,), InputError, "JointPath: configurations"),
        (([[0.0] * 12] * 2, [1, 1]), InputError, "JointPath: index"),
        (([[0.0] * 12] * 2, None, 0.0), InputError, "certified_minimum: tolerance = 0.0"),
        (([[0.0] * 12] * 2, None, 0.1, np.nan), InputError, "certified_minimum: enough = nan"),
    ],
)
def test_bad_arguments(arguments, error, message):
    with pytest.raises(error, match=message):
        certified_minimum(two_arms(obstacles=False), *arguments)
