"""Certified edges against densely sampled distances, for every sort of body."""

import numpy as np
import pinocchio as pin
import pytest

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
    distances,
)
from dualarm_repro.scene.edge_kernels import LANES, edge_buffers, place_block, set_joints
from dualarm_repro.scene.edge_model import edge_model
from dualarm_repro.scene.edges import free_edges
from dualarm_repro.scene.lane_distances import unsure_box, unsure_capsules, unsure_plane
from dualarm_repro.scene.placement import place
from dualarm_repro.scene.segments import segment_segment

MARGIN = 0.004


def _placed(name, robot, x, turn):
    turned = pin.rpy.rpyToMatrix(0.0, 0.0, turn)
    return PlacedArm(name, load_arm(robot), pin.SE3(turned, np.array([x, 0.0, 0.0])))


@pytest.fixture(scope="module")
def scene():
    """Two arms, a third that is parked, and one body of every sort."""
    arms = [_placed("left", "irb120", -0.4, 0.0), _placed("right", "irb120", 0.4, np.pi)]
    parked = PlacedArm("third", load_arm("irb120"), pin.SE3(np.eye(3), np.array([0.0, 0.55, 0.0])))
    corners = np.random.default_rng(5).normal(size=(12, 3)) * 0.08 + [-0.1, -0.5, 0.4]
    solids = {
        "ball": Sphere([0.0, 0.1, 0.75], 0.05),
        "bar": Capsule([-0.3, -0.4, 0.1], [0.3, -0.4, 0.7], 0.04),
        "box": Box([0.0, 0.45, 0.2], [0.3, 0.1, 0.2], pin.rpy.rpyToMatrix(0.2, 0.3, 0.4)),
        "stone": ConvexHull(corners),
    }
    whole = Scene([*arms, parked], solids, floor=-0.05)
    return whole.replaying("third", JointPath([[-1.6, 0.5, -0.2, 0.0, 0.4, 0.0]]))


def _edges(scene, count, seed, width=0.5):
    rng = np.random.default_rng(seed)
    starts = rng.uniform(*scene.limits, (count, scene.nq)) * 0.7
    return starts, starts + rng.uniform(-width, width, starts.shape)


def _smallest(scene, starts, ends, samples=201):
    share = np.linspace(0.0, 1.0, samples)[:, np.newaxis]
    pairs = zip(starts, ends, strict=True)
    return np.array([distances(scene, a + share * (b - a)).min() for a, b in pairs])


def test_free_is_never_claimed_wrongly_and_seldom_missed(scene):
    """Both answers occur; what is missed keeps the margin by less than the finest stretch."""
    starts, ends = _edges(scene, 300, 1)
    free, smallest = free_edges(scene, starts, ends, MARGIN), _smallest(scene, starts, ends)
    assert 0.1 < free.mean() < 0.9
    assert (smallest[free] > MARGIN).all()
    assert (smallest[~free] <= MARGIN + 1e-4).all()


def test_every_sort_of_body_bars_edges(scene):
    """Without one of the bodies some edge that was barred is free."""
    starts, ends = _edges(scene, 1500, 2)
    free = free_edges(scene, starts, ends)
    for name in scene.obstacles:
        rest = {other: solid for other, solid in scene.obstacles.items() if other != name}
        fewer = Scene(scene.arms, rest, scene.moving, scene.floor)
        more = free_edges(fewer, starts, ends)
        assert (more | ~free).all()
        assert (more & ~free).any(), name
    bare = Scene(scene.arms, scene.obstacles, floor=scene.floor)
    assert (free_edges(bare, starts, ends) & ~free).any()


def test_threads_do_not_change_the_answer(scene):
    starts, ends = _edges(scene, 500, 3)
    alone = free_edges(scene, starts, ends, MARGIN)
    for jobs in (2, 3, 8):
        np.testing.assert_array_equal(free_edges(scene, starts, ends, MARGIN, jobs), alone)


def test_edge_and_its_reverse_and_its_halves_agree(scene):
    starts, ends = _edges(scene, 200, 4)
    free = free_edges(scene, starts, ends, MARGIN)
    clear = np.abs(_smallest(scene, starts, ends) - MARGIN) > 1e-4
    np.testing.assert_array_equal(free_edges(scene, ends, starts, MARGIN)[clear], free[clear])
    middle = 0.5 * (starts + ends)
    both = free_edges(scene, starts, middle, MARGIN) & free_edges(scene, middle, ends, MARGIN)
    np.testing.assert_array_equal(both[clear], free[clear])


def test_edge_without_length_is_looked_at(scene):
    starts, _ = _edges(scene, 200, 5)
    right = distances(scene, starts).min(axis=1) > MARGIN
    assert 0 < right.sum() < 200
    np.testing.assert_array_equal(free_edges(scene, starts, starts, MARGIN), right)


JOINT = """<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>
<origin xyz='0.1 0 0.2' rpy='0.1 0.2 0.3'/><axis xyz='{axis}'/>
<limit lower='-0.5' upper='0.5' effort='1' velocity='1'/></joint>"""
LINK = """<link name='{name}'><collision><geometry><cylinder radius='0.04' length='0.3'/></geometry>
</collision></link>"""


def test_arm_with_joints_that_slide(tmp_path):
    kinds = ("revolute", "prismatic", "revolute", "prismatic")
    axes = ("0 0 1", "0 0.6 0.8", "0 1 0", "1 0 0")
    parts = [LINK.format(name=f"l{k}") for k in range(5)]
    parts += [
        JOINT.format(name=f"j{k}", kind=kind, parent=f"l{k}", child=f"l{k + 1}", axis=axis)
        for k, (kind, axis) in enumerate(zip(kinds, axes, strict=True))
    ]
    path = tmp_path / "lift.urdf"
    path.write_text(f"<robot name='lift'>{''.join(parts)}</robot>", encoding="utf-8")
    placed = PlacedArm("arm", load_arm(path, shapes="enclosing"))
    scene = Scene([placed], {"ball": Sphere([0.35, 0.1, 0.7], 0.1)})
    starts, ends = _edges(scene, 200, 6)
    ends = np.clip(ends, *scene.limits)
    free, smallest = free_edges(scene, starts, ends), _smallest(scene, starts, ends)
    assert 0.1 < free.mean() < 0.9
    assert (smallest[free] > 0.0).all()
    assert (smallest[~free] <= 1e-4).all()
    with pytest.raises(ConfigurationError, match="slide"):
        free_edges(scene, starts, ends + np.array([0.0, 9.0, 0.0, 0.0]))


def _block(cores):
    middle, half = cores.mean(axis=1), 0.5 * (cores[:, 1] - cores[:, 0])
    return np.concatenate([middle.T, half.T]).reshape(-1)


@pytest.mark.parametrize("parallel", [False, True])
def test_distance_in_lanes_is_that_of_segments(parallel):
    """A lane is unsure exactly up to the distance of the cores."""
    rng = np.random.default_rng(7)
    length = 0.6
    for _ in range(50):
        first = rng.normal(size=(LANES, 2, 3))
        turn = first[:, 1] - first[:, 0] if parallel else rng.normal(size=(LANES, 3))
        ways = [first[:, 1] - first[:, 0], turn]
        ways = [length * way / np.linalg.norm(way, axis=1, keepdims=True) for way in ways]
        starts = [first[:, 0], rng.normal(size=(LANES, 3))]
        cores = [np.stack([p, p + w], axis=1) for p, w in zip(starts, ways, strict=True)]
        right = np.array(
            [segment_segment(*map(tuple, (starts[0][k], ways[0][k], starts[1][k], ways[1][k])))[0]
             for k in range(LANES)]
        )  # fmt: skip
        blocks = [_block(one) for one in cores]
        for change, bits in ((1e-9, (1 << LANES) - 1), (-1e-9, 0)):
            apart = 1e-12
            halves = right + change - apart
            found = unsure_capsules(*blocks, 0.5 * length, 0.5 * length, apart, 1.0, halves)
            assert found == bits


def test_box_and_plane_in_lanes_report_contact():
    core = np.tile(np.array([[0.0, 0.0, 0.5], [0.0, 0.0, 1.5]]), (LANES, 1, 1))
    block, halves = _block(core), np.zeros(LANES)
    plane, pose, half = np.array([0.0, 0.0, 1.0, 0.0]), np.eye(3, 4), np.full(3, 0.2)
    assert unsure_plane(block, plane, 0.49, 1.0, halves) == 0
    assert unsure_plane(block, plane, 0.51, 1.0, halves) < 0
    assert unsure_box(block, pose, half, 0.5, 0.29, 1.0, halves) == 0
    assert unsure_box(block, pose, half, 0.5, 0.31, 1.0, halves) < 0
    assert unsure_box(block, pose, half, 0.5, 0.29, 1.0, halves + 0.02) == (1 << LANES) - 1


def test_wrong_input_is_named(scene):
    starts, ends = _edges(scene, 3, 8)
    with pytest.raises(ConfigurationError, match="as many"):
        free_edges(scene, starts, ends[:2])
    with pytest.raises(InputError, match="margin"):
        free_edges(scene, starts, ends, -1.0)
    with pytest.raises(InputError, match="jobs"):
        free_edges(scene, starts, ends, jobs=0)
    for name, value in (("margin", "a"), ("jobs", 1.5)):
        with pytest.raises(InputError, match=f"{name}.*expected"):
            free_edges(scene, starts, ends, **{name: value})
    for far in (1.1e6, 1e17, 1e150):  # a sine of which would be noise, or none
        with pytest.raises(ConfigurationError, match=r"angles of at most 1e\+06 rad"):
            free_edges(scene, starts + far * np.eye(scene.nq)[0], ends)
    track = PosePath([pin.SE3.Identity()] * 2, [0.0, 9.0])
    moving = Scene(scene.arms, moving={"ball": MovingShape(Sphere([0.0, 0.0, 2.0], 0.1), track)})
    with pytest.raises(InputError, match="ball"):
        free_edges(moving, starts, ends)


def test_poses_of_a_block_are_those_of_the_scene(scene):
    model = edge_model(scene)
    start, end = (one[0] for one in _edges(scene, 1, 9))
    buffers = edge_buffers(model)
    w, turns, _, ends, *_ = buffers
    w[14 * LANES : 15 * LANES] = share = np.linspace(0.0, 1.0, LANES)
    set_joints(start, end, w, turns)
    place_block(model, w, turns, ends)
    q = start + share[:, np.newaxis] * (end - start)
    cores = place(scene, q, np.zeros(LANES)).cores
    middles = cores.mean(axis=2)
    for row in ends:
        middle = row[: 3 * LANES].reshape(3, LANES).T[:, np.newaxis]
        assert np.abs(middles - middle).max(axis=(0, 2)).min() < 1e-12
