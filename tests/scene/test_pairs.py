import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import UnknownNameError
from dualarm_repro.scene import (
    JointPath,
    MovingShape,
    PlacedArm,
    PosePath,
    Scene,
    Sphere,
    clearance,
    distances,
    pairs,
)
from dualarm_repro.scene.pairs import SORTS, always_overlapping
from dualarm_repro.scene.posing import frames_of, links_of
from examples import two_arms


@pytest.fixture(scope="module")
def scene():
    return two_arms(floor=-0.2)


def owners(pair):
    return {body.owner for body in pair}


def test_every_link_meets_every_obstacle(scene):
    names = set(scene.pairs.names)
    moving = [b for b in scene.bodies.all if b.joint]
    obstacles = [b for b in scene.bodies.all if b.joint is None]
    assert {body.sort for body in obstacles} == set(SORTS)
    assert {b.name for b in obstacles} == {
        "ball", "pole", "window/0", "window/1", "window/2", "window/3", "wall", "stone", "floor",
    }  # fmt: skip
    for link in moving:
        assert all((link.name, obstacle.name) in names for obstacle in obstacles)


def test_links_of_two_arms_meet_but_not_their_bases(scene):
    left, right = ([b for b in scene.bodies.all if b.owner == arm] for arm in ("left", "right"))
    between = {
        pair for pair in scene.pairs.names if pair[0][:4] == "left" and pair[1][:5] == "right"
    }
    assert len(between) == len(left) * len(right) - 1
    assert ("left/capsule_0_joint_0", "right/capsule_0_joint_0") not in between


def test_bodies_that_never_move_are_no_pair(scene):
    assert not any(a.still and b.still for a, b in scene.pairs.bodies)
    assert not any(pair == ("left/capsule_0_joint_0", "floor") for pair in scene.pairs.names)


def test_self_pairs_skip_neighbours_and_links_that_always_overlap(scene):
    own = [pair for pair in scene.pairs.bodies if owners(pair) == {"left"}]
    assert own
    overlapping = always_overlapping(load_arm("irb120"))
    for a, b in own:
        assert abs(a.joint - b.joint) > 1
        assert not overlapping[a.link, b.link]
    assert overlapping.any()
    off = two_arms(self_collision=False)
    assert not any(len(owners(pair)) == 1 for pair in off.pairs.bodies)


@pytest.mark.parametrize("name", ["panda", "kinova-j2s6s200"])
def test_neighbours_are_no_pair_even_where_they_keep_apart(name):
    arm = load_arm(name)
    joint = links_of(arm).joint
    near = np.abs(joint[:, None] - joint) <= 1
    assert (near & ~always_overlapping(arm)).any()
    assert all(abs(a.joint - b.joint) > 1 for a, b in Scene([PlacedArm("arm", arm)]).pairs.bodies)


def test_always_overlapping_agrees_with_random_configurations():
    arm = load_arm("irb120")
    mask = always_overlapping(arm)
    scene = Scene([PlacedArm("arm", arm)])
    q = arm.random_configurations(500, np.random.default_rng(0))
    for (a, b), distance in zip(scene.pairs.bodies, distances(scene, q).T, strict=True):
        assert not mask[a.link, b.link]
        assert distance.max() > 0


def test_exempt_bodies_and_owners(scene):
    names = set(scene.pairs.names)
    assert ("left/capsule_4_joint_4", "ball") in names
    one = two_arms(floor=-0.2, exempt=[("ball", "left/capsule_4_joint_4")])
    assert names - set(one.pairs.names) == {("left/capsule_4_joint_4", "ball")}
    arms = two_arms(floor=-0.2, exempt=[("left", "right"), ("left", "window")])
    gone = names - set(arms.pairs.names)
    assert all(a.startswith("left") and b[:5] in ("right", "windo") for a, b in gone)
    assert len(gone) == scene.pairs.between("left", "right").sum() + 4 * 5


def test_exempt_pairs_change_no_other_distance(scene):
    q = np.random.default_rng(1).uniform(-1, 1, (5, scene.nq))
    fewer = two_arms(floor=-0.2, exempt=[("left", "window"), ("right/capsule_3_joint_3", "floor")])
    kept = [scene.pairs.names.index(pair) for pair in fewer.pairs.names]
    np.testing.assert_allclose(distances(fewer, q), distances(scene, q)[:, kept], atol=1e-14)


def test_between_selects_pairs_of_two_owners(scene):
    mask = scene.pairs.between("ball", "right")
    assert [scene.pairs.names[k] for k in np.flatnonzero(mask)] == [
        pair for pair in scene.pairs.names if pair[1] == "ball" and pair[0].startswith("right")
    ]
    np.testing.assert_array_equal(mask, scene.pairs.between("right", "ball"))
    assert scene.pairs.between("left", "floor").any()


def test_unknown_names_list_the_known_ones(scene):
    with pytest.raises(UnknownNameError, match=r"body = 'lamp': expected one of .*ball.*window/3"):
        scene.pairs.between("left", "lamp")
    with pytest.raises(UnknownNameError, match="body = 'lamp'"):
        two_arms(exempt=[("left", "lamp")])


def test_moving_bodies_meet_links_only():
    scene = Scene(
        [PlacedArm("arm", load_arm("irb120"))],
        {"ball": Sphere((1, 1, 1), 0.1)},
        {"drone": MovingShape(Sphere((0, 0, 0), 0.1), PosePath([pin.SE3.Identity()]))},
    )
    assert ("drone", "ball") not in scene.pairs.names
    assert scene.pairs.between("arm", "drone").sum() == 6
    assert scene.pairs.between("arm", "ball").sum() == 5  # the base and the ball both stand still
    pair = two_arms(obstacles=False).replaying("right", JointPath(np.zeros((2, 6))))
    assert {b.owner for _, b in pair.pairs.bodies} == {"left", "right"}
    assert all(a.owner == "left" for a, _ in pair.pairs.bodies)
    base = ("left/capsule_0_joint_0", "right/capsule_3_joint_3")
    assert base in pair.pairs.names  # a fixed link, yet the other one moves
    assert clearance(pair, np.zeros(6)).minimum < np.inf


def test_overlap_is_looked_for_all_over_the_joint_limits_and_nowhere_else(monkeypatch):
    arm, seen = load_arm("irb120"), []

    def frames(arm, base, q):
        seen.append(q)
        return frames_of(arm, base, q)

    monkeypatch.setattr(pairs, "frames_of", frames)
    always_overlapping(arm)
    (q,) = seen
    assert (q >= arm.lower).all()
    assert (q <= arm.upper).all()
    share = (q - arm.lower) / (arm.upper - arm.lower)
    assert (share.min(axis=0) < 0.1).all()
    assert (share.max(axis=0) > 0.9).all()


TWO_PLATES = """<robot name="plates"><link name="b"><collision><geometry><box size="0.6 0.4 0.02"/>
</geometry></collision></link><link name="l1"><collision><origin xyz="0 0 0.4"/><geometry>
<box size="0.5 0.4 0.02"/></geometry></collision></link>
<joint name="j1" type="revolute"><parent link="b"/><child link="l1"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>"""


@pytest.fixture
def plates(tmp_path):
    """An arm of two plates, each fitted by several capsules."""
    (tmp_path / "plates.urdf").write_text(TWO_PLATES, encoding="utf-8")
    return PlacedArm("arm", load_arm(tmp_path / "plates.urdf"))


@pytest.mark.parametrize("name", ["arm/l1", "arm/l1_0", "arm"])
def test_a_link_or_a_shape_stands_for_all_its_capsules(plates, name):
    ball = {"ball": Sphere([0.0, 0.0, 0.4], 0.1), "other": Sphere([0.0, 0.0, 0.5], 0.1)}
    whole = Scene([plates], ball)
    upper = {a for a, _ in whole.pairs.names if a.startswith("arm/l1_0.")}
    assert len(upper) > 1
    left = Scene([plates], ball, exempt=[(name, "ball")])
    assert {b for _, b in left.pairs.names} == {"other"}
    assert {a for a, _ in left.pairs.names} == upper
    assert whole.pairs.between(name, "ball").sum() == len(upper)


def test_names_that_nobody_has_are_told_with_shapes_and_not_with_capsules(plates):
    with pytest.raises(UnknownNameError) as caught:
        Scene([plates], {"wall_1": Sphere([0, 0, 1], 0.1)}, exempt=[("arm/l2", "wall_1")])
    assert caught.value.expected == "one of arm, arm/b_0, arm/l1_0, wall_1"
    with pytest.raises(UnknownNameError):  # only links of arms are known without their number
        Scene([plates], {"wall_1": Sphere([0, 0, 1], 0.1)}, exempt=[("arm", "wall")])
