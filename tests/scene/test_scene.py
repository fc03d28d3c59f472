import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import ConfigurationError, InputError, UnknownNameError
from dualarm_repro.scene import (
    HalfSpace,
    JointPath,
    MovingArm,
    MovingShape,
    PlacedArm,
    PosePath,
    Scene,
    Sphere,
    clearance,
    distances,
)
from examples import two_arms

BALL = Sphere((0, 0, 2), 0.1)


def test_joint_vectors_are_stacked_in_order_of_the_arms():
    scene = two_arms(obstacles=False)
    left, right = np.arange(6.0), np.arange(6.0, 12)
    assert scene.nq == 12
    np.testing.assert_array_equal(scene.stack(right=right, left=left), np.arange(12))
    np.testing.assert_array_equal(
        scene.stack(left=[left, left], right=[right, right]), [np.arange(12)] * 2
    )
    assert scene.columns == {"left": slice(0, 6), "right": slice(6, 12)}


def test_bad_joint_vectors():
    scene = two_arms(obstacles=False)
    with pytest.raises(UnknownNameError, match=r"arms = \['left'\]: expected all of left, right"):
        scene.stack(left=np.zeros(6))
    with pytest.raises(ConfigurationError, match="irb120: shape of q"):
        scene.stack(left=np.zeros(5), right=np.zeros(6))
    with pytest.raises(ConfigurationError, match=r"rows of the arms.*as many for each arm"):
        scene.stack(left=np.zeros((2, 6)), right=np.zeros(6))
    for bad in (np.zeros(11), np.zeros((1, 1, 12)), np.full(12, np.nan), "q", [[1], [1, 2]]):
        with pytest.raises(ConfigurationError, match=r"scene: .*q.*expected 12 finite numbers"):
            clearance(scene, bad)


@pytest.mark.parametrize("time", [np.nan, [1, 2, 3], "noon"])
def test_bad_time(time):
    with pytest.raises(InputError, match="scene: time = "):
        clearance(two_arms(obstacles=False), np.zeros((2, 12)), time)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"arms": []}, "Scene: arms = .*at least one arm"),
        ({"obstacles": {"arm": BALL}}, "Scene: name = 'arm': expected distinct names"),
        ({"obstacles": {"a/b": BALL}}, "Scene: name = 'a/b'"),
        ({"obstacles": {"": BALL}}, "Scene: name = ''"),
        ({"obstacles": {"floor": BALL}, "floor": 0.0}, "Scene: name = 'floor'"),
        ({"floor": np.nan}, "Scene: floor = nan"),
        (
            {"obstacles": {"ball": "round"}},
            "obstacle ball/0: shape = 'r': expected Sphere, Capsule",
        ),
        ({"obstacles": {"ball": None}}, "obstacle ball: shape = None"),
    ],
)
def test_bad_scenes(options, message):
    arms = [PlacedArm("arm", load_arm("irb120"))]
    with pytest.raises(InputError, match=message):
        Scene(**{"arms": arms, **options})


def test_bad_arms():
    arm = load_arm("irb120")
    nowhere = pin.SE3(np.eye(3), np.array([0, 0, np.nan]))
    with pytest.raises(InputError, match=r"arm a: placement.*finite pinocchio\.SE3"):
        PlacedArm("a", arm, nowhere)
    with pytest.raises(InputError, match="arm a: placement"):
        PlacedArm("a", arm, (0, 0, 0))
    with pytest.raises(InputError, match="MovingArm: placement"):
        MovingArm(arm, JointPath(np.zeros((1, 6))), nowhere)
    with pytest.raises(ConfigurationError, match="irb120: shape of q"):
        PlacedArm("a", arm, start=np.zeros(7))


def test_half_space_cannot_move():
    with pytest.raises(InputError, match=r"MovingShape: shape.*Sphere, Capsule, Box or ConvexHull"):
        MovingShape(HalfSpace((0, 0, 1), 0), PosePath([pin.SE3.Identity()]))


def test_moving_name_may_not_repeat_another():
    mover = MovingShape(BALL, PosePath([pin.SE3.Identity()]))
    with pytest.raises(InputError, match="name = 'ball'"):
        Scene([PlacedArm("arm", load_arm("irb120"))], {"ball": BALL}, {"ball": mover})


def test_replayed_arm_has_the_distances_of_the_controlled_one():
    scene = two_arms(floor=-0.3)
    rng = np.random.default_rng(0)
    path = rng.uniform(-1, 1, (5, 6))
    replay = scene.replaying("right", JointPath(path))
    assert replay.nq == 6
    assert replay.columns == {"left": slice(0, 6)}
    q = rng.uniform(-1, 1, (40, 6))
    time = rng.uniform(-1, 6, 40)
    found = distances(replay, q, time)
    together = distances(scene, scene.stack(left=q, right=JointPath(path).at(time)))
    kept = [scene.pairs.names.index(pair) for pair in replay.pairs.names]
    np.testing.assert_allclose(found, together[:, kept], atol=1e-12)


def test_replaying_an_arm_that_is_not_there():
    with pytest.raises(UnknownNameError, match="arm = 'middle': expected one of left, right"):
        two_arms(obstacles=False).replaying("middle", JointPath(np.zeros((1, 6))))


def test_support_says_which_joints_change_a_pair():
    scene = two_arms(floor=-0.3)
    for row, (a, b) in zip(scene.support, scene.pairs.bodies, strict=True):
        left, right = row[:6], row[6:]
        if a.owner == b.owner == "right":
            expected = np.r_[np.zeros(a.joint), np.ones(b.joint - a.joint), np.zeros(6 - b.joint)]
            np.testing.assert_array_equal(right, expected)
            assert not left.any()
        elif b.owner == "right":
            np.testing.assert_array_equal(left, -(np.arange(6) < a.joint).astype(float))
            np.testing.assert_array_equal(right, (np.arange(6) < b.joint).astype(float))
