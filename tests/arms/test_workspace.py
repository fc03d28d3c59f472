"""Workspace: clouds, volumes against closed forms, overlap."""

import numpy as np
import pinocchio as pin
import pytest
from numpy.testing import assert_allclose

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.occupancy import occupancy, rotation_volumes
from dualarm_repro.arms.overlap import overlap
from dualarm_repro.arms.workspace import extents, sample_workspace, voxel_volume
from dualarm_repro.errors import InputError

SHELL = 4 / 3 * np.pi * ((0.7 + 0.4) ** 3 - (0.7 - 0.4) ** 3)


def placed(*translation):
    return np.eye(3), np.array(translation, dtype=float)


def test_cloud_is_the_seeded_image_of_the_configurations():
    arm = load_arm("es165d")
    cloud = sample_workspace(arm, 5000, np.random.default_rng(4))
    again = arm.random_configurations(5000, np.random.default_rng(4))
    assert_allclose(cloud, arm.fk(again)[:, :3, 3], atol=1e-12)
    assert_allclose(cloud, sample_workspace(arm, 5000, np.random.default_rng(4)), atol=0)


def test_extents_of_a_shell(two_links):
    arm = load_arm(two_links())
    reach = extents(sample_workspace(arm, 200_000, np.random.default_rng(0)))
    assert_allclose(reach.distance, (0.3, 1.1), atol=1e-3)
    assert_allclose(reach.upper, 1.1, atol=0.02)  # few samples come near a pole
    assert_allclose(reach.lower, -1.1, atol=0.02)  # as above
    assert reach.radius[0] < 0.01
    assert reach.radius[1] == pytest.approx(1.1, abs=1e-3)


def test_reach_of_the_es165d():
    """Wrist 0.285 + 1.024 + hypot(1.225, 0.250), flange 0.225 beyond it at most."""
    arm = load_arm("es165d")
    reach = extents(sample_workspace(arm, 200_000, np.random.default_rng(0)))
    assert 2.7 < reach.distance[1] < 0.285 + 1.024 + np.hypot(1.225, 0.250) + 0.225


def test_volume_of_a_shell_converges_with_the_cell(two_links):
    table = rotation_volumes(load_arm(two_links()), [0.08, 0.04, 0.02, 0.01], seed=0)
    errors = [row.volume / SHELL - 1 for row in table]
    assert all(error > -1e-3 for error in errors), "cut cells count whole"
    assert sorted(errors, reverse=True) == errors
    assert errors[-1] < 0.03
    ratios = np.divide(errors[:-1], errors[1:])
    assert (ratios > 1.5).all(), "an error of the first order in the cell"
    assert max(row.unseen for row in table) < 1e-3


@pytest.mark.parametrize(
    ("q1", "q2", "share"),
    [
        (("-pi/2", "pi/2"), ("-pi", "pi"), 1.0),  # forwards and backwards: the full turn
        (("-pi/4", "pi/4"), ("-pi", "pi"), 0.5),  # two quarters
        ((0, "pi/2"), ("-pi", "pi"), 0.5),
    ],
)
def test_partial_turn_of_joint_1(q1, q2, share, two_links):
    arm = load_arm(two_links(q1=q1, q2=q2))
    reached = occupancy(arm, 0.02, np.random.default_rng(0), samples=400_000)
    assert reached.volume().volume == pytest.approx(share * SHELL, rel=0.08)  # cells on the skin
    if share < 1:
        inside, beside = (0.9, 0.3, 0.0), (-0.3, 0.9, 0.0)
        points = np.array([inside, np.negative(inside), beside])
        assert reached.contains(points).tolist() == [True, True, False]


def test_points_of_the_arm_are_inside_and_others_are_not(two_links, rng):
    for arm in (load_arm(two_links()), load_arm("irb120"), load_arm("panda")):
        reached = occupancy(arm, 0.03, np.random.default_rng(0), samples=500_000)
        cloud = sample_workspace(arm, 20_000, rng)
        assert reached.contains(cloud).mean() > 0.999
        corners = reached.corners()
        assert (cloud > corners.min(axis=0)).all()
        assert (cloud < corners.max(axis=0)).all()
        assert not reached.contains(np.array([[9.0, 0, 0], [0, 0, 9.0], [0, 0, -9.0]])).any()
    assert not occupancy(load_arm(two_links()), 0.03, rng, 500_000).contains(np.zeros((1, 3)))[0]


def test_voxel_volume_depends_on_the_cell():
    cloud = sample_workspace(load_arm("es165d"), 100_000, np.random.default_rng(0))
    table = voxel_volume(cloud, [0.05, 0.1, 0.2, 0.3])
    assert [row.volume for row in table] == sorted(row.volume for row in table)
    assert table[-1].volume > 5 * table[0].volume
    cube = np.stack(np.meshgrid(*[np.arange(10) + 0.5] * 3), axis=-1).reshape(-1, 3)
    assert voxel_volume(cube, [1.0, 5.0]) == [(1.0, 1000, 1000.0), (5.0, 8, 1000.0)]


def lens(distance, radius):
    """Volume common to two balls of one radius."""
    return np.pi * (4 * radius + distance) * (2 * radius - distance) ** 2 / 12


def test_overlap_of_two_balls(two_links):
    """Links of equal length reach a whole ball."""
    arm = load_arm(two_links(l1=0.5, l2=0.5))
    half = pin.SE3(pin.rpy.rpyToMatrix(0.3, 0.2, 0.1), np.array([0.0, 0.0, 0.0]))
    common = overlap((arm, half), (arm, placed(1.0, 0, 0)), seed=3, cell=0.01, points=100_000)
    # a ball of cells of 0.01 m is up to half a cell too large all round
    assert common.volume.value == pytest.approx(lens(1.0, 1.0), rel=0.04)
    assert common.volume.low < common.volume.value < common.volume.high
    assert common.volume.high - common.volume.low < 0.03 * common.volume.value
    assert common.first_in_second.low < common.first_in_second.value < common.first_in_second.high
    # two samples of 100 000 points each
    assert common.first_in_second.value == pytest.approx(common.second_in_first.value, abs=0.01)


def test_overlap_is_seeded_and_symmetric():
    first = (load_arm("es165d"), placed(0, 1.5, 0))
    second = (load_arm("irb120"), placed(1.0, 0, 0.5))
    few = {"samples": 200_000, "points": 20_000, "cell": 0.05}
    one, other = overlap(first, second, seed=1, **few), overlap(second, first, seed=1, **few)
    assert one == overlap(first, second, seed=1, **few)
    assert one != overlap(first, second, seed=2, **few)
    assert one.volume == other.volume
    assert one.first_in_second == other.second_in_first
    assert one.second_in_first == other.first_in_second
    assert one.volume.value > 0.1


def test_no_overlap_far_apart_and_all_of_it_in_place():
    arm = load_arm("er16")
    few = {"seed": 0, "samples": 300_000, "points": 20_000, "cell": 0.05}
    far = overlap((arm, placed(0, 0, 0)), (arm, placed(9, 0, 0)), **few)
    assert far.volume.value == far.volume.high == 0.0
    assert far.first_in_second.value == 0.0
    same = overlap((arm, placed(0, 0, 0)), (arm, pin.SE3.Identity()), **few)
    assert same.first_in_second.value > 0.999
    whole = occupancy(arm, 0.05, np.random.default_rng(0), 300_000).volume().volume
    # cells on the skin that one of two samples misses
    assert same.volume.value == pytest.approx(whole, rel=0.03)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"points": 0}, "points"),
        ({"samples": 0}, "samples"),
        ({"cell": 0.0}, "cell"),
        ({"cell": np.nan}, "cell"),
        ({"second": (2 * np.eye(3), np.zeros(3))}, "placement"),
        ({"second": (np.eye(3), np.zeros(2))}, "placement"),
        ({"second": "here"}, "placement"),
    ],
)
def test_wrong_input(change, field):
    arm = load_arm("irb120")
    second = (arm, change.pop("second", placed(0, 0, 0)))
    with pytest.raises(InputError) as caught:
        overlap((arm, placed(0, 0, 0)), second, seed=0, **change)
    assert caught.value.field == field
    with pytest.raises(InputError):
        voxel_volume(np.zeros((1, 3)), [0.0])


@pytest.mark.parametrize("points", [np.empty((0, 3)), np.zeros(3), np.zeros((4, 2))])
def test_a_cloud_has_points(points):
    line = r"points \(its shape\) = .*: expected finite numbers \(N, 3\), not empty"
    with pytest.raises(InputError, match=f"extents: {line}"):
        extents(points)
    with pytest.raises(InputError, match=f"voxel_volume: {line}"):
        voxel_volume(points, [0.1])
