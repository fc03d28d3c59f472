"""Control points: which points of the arm they are, checked against the frames of the arm."""

import numpy as np
import pytest
from window_scene import MASTER, SLAVE

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import InputError
from dualarm_repro.planning import control_points
from dualarm_repro.planning.field.control_points import end_effector, ends_of
from dualarm_repro.scene import PlacedArm
from dualarm_repro.scene.posing import links_of

Q = np.random.default_rng(1).uniform(-1.5, 1.5, (4, 6))


def origins(placed):
    """Origins of joint frames 1 ... nq and of the flange in the world (N, nq + 1, 3)."""
    local = placed.arm.joint_positions(Q)
    return local @ placed.placement.rotation.T + placed.placement.translation


@pytest.mark.parametrize("placed", [MASTER, SLAVE, PlacedArm("left", load_arm("irb120"))])
@pytest.mark.parametrize(
    ("choice", "frames"),
    [
        ("frames_2_6", range(2, 7)),
        ("frames_1_5", range(1, 6)),
        ("end_effector", [7]),
        ((3, 5, 7), [3, 5, 7]),
    ],
)
def test_points_are_the_origins_of_frames(placed, choice, frames):
    points = control_points(placed.arm, choice)
    ends = ends_of(placed, points, Q)
    expected = origins(placed)[:, np.array(frames) - 1]
    assert np.abs(ends[:, :, 0] - expected).max() < 1e-12
    assert np.abs(ends[:, :, 1] - expected).max() < 1e-12


def test_links_join_the_origins():
    ends = ends_of(MASTER, control_points(MASTER.arm, "five_links"), Q)
    expected = origins(MASTER)
    assert np.abs(ends[:, :, 0] - expected[:, 0:5]).max() < 1e-12
    assert np.abs(ends[:, :, 1] - expected[:, 1:6]).max() < 1e-12


def test_capsules_are_those_of_the_collision_check():
    points, links = control_points(MASTER.arm, "capsules"), links_of(MASTER.arm)
    assert sorted(points.radius) == sorted(links.radius)
    assert set(points.names) == set(links.names)
    assert set(control_points(MASTER.arm, "capsules", radius=0.05).radius) == {0.05}


def test_flange_of_the_world():
    assert np.abs(end_effector(SLAVE, Q) - origins(SLAVE)[:, 6]).max() < 1e-12
    assert end_effector(SLAVE, Q[0]) == pytest.approx(end_effector(SLAVE, Q)[0])


def test_points_come_from_base_to_flange_with_their_weights():
    points = control_points(MASTER.arm, (7, 2, 5), weights=(3.0, 1.0, 2.0))
    assert points.names == ("frame_2", "frame_5", "flange")
    assert points.weight.tolist() == [1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ("choice", "weights", "expected"),
    [
        ((2, 8), None, "a frame from 1 to 7"),
        ((0,), None, "a frame from 1 to 7"),
        ("frames_2_6", (1.0,), "5 weights"),
    ],
)
def test_what_the_arm_does_not_have(choice, weights, expected):
    with pytest.raises(InputError, match=expected):
        control_points(MASTER.arm, choice, weights)
