"""Inverse kinematics of arms without a closed form: reached poses, free axes, honest residuals."""

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import InputError
from dualarm_repro.planning.tasks.configuration import joints_of
from dualarm_repro.planning.tasks.numeric_ik import PoseGoal, pose_errors, pose_posture
from dualarm_repro.scene import PlacedArm
from dualarm_repro.scene.configuration_entry import PostureEntry

BASE = pin.SE3(pin.rpy.rpyToMatrix(0.1, 0.2, 0.3), np.array([0.1, 0.2, 0.3]))


def placed(name):
    return PlacedArm("arm", load_arm(name), BASE)


def world(one, q):
    return one.placement.homogeneous @ one.arm.fk(q)


@pytest.mark.parametrize("name", ["panda", "ur5", "irb120"])
def test_every_pose_of_the_arm_is_found_again(name):
    one, rng = placed(name), np.random.default_rng(3)
    for q in one.arm.random_configurations(4, rng):
        wanted = world(one, q)
        found = pose_posture(one, PoseGoal(wanted[:3, 3], wanted[:3, :3]), np.zeros(one.arm.nq))
        assert found.reached
        assert world(one, found.q) == pytest.approx(wanted, abs=1e-5)
        assert one.arm.within_limits(found.q, 1e-9)


@pytest.mark.parametrize("axis", [0, 2])
def test_a_free_axis_leaves_the_turn_about_it_open(axis):
    one = placed("ur5")
    (q,) = one.arm.random_configurations(1, np.random.default_rng(5))
    wanted = world(one, q)
    goal = PoseGoal(wanted[:3, 3], wanted[:3, :3], axis)
    found = pose_posture(one, goal, np.zeros(6))
    assert found.reached
    reached = world(one, found.q)
    assert reached[:3, axis] == pytest.approx(wanted[:3, axis], abs=1e-5)
    turned = wanted[:3, :3] @ pin.AngleAxis(1.0, np.eye(3)[axis]).matrix()
    assert pose_errors(one, PoseGoal(wanted[:3, 3], turned, axis), q) == pytest.approx((0, 0))
    other = (axis + 1) % 3
    assert pose_errors(one, PoseGoal(wanted[:3, 3], turned, other), q)[1] == pytest.approx(1.0)


def test_of_several_postures_a_clear_one_is_taken():
    one = placed("irb120")
    q = np.array([0.3, 0.4, -0.6, 0.5, 0.8, 0.1])
    wanted = world(one, q)
    goal = PoseGoal(wanted[:3, 3], wanted[:3, :3])
    near = pose_posture(one, goal, q).q
    assert near == pytest.approx(q, abs=1e-4)
    other = pose_posture(one, goal, q, clear=lambda found: np.abs(found - q).max() > 0.1)
    assert other.reached
    assert np.abs(other.q - q).max() > 0.1


def test_an_orientation_out_of_reach_is_told_with_its_residual():
    """A tool that points back at the base from the edge of the reach."""
    one = PlacedArm("arm", load_arm("irb120"))
    edge = one.arm.fk([0.0, 0.9, -0.6, 0, 0, 0])[:3, 3]
    entry = PostureEntry(position=tuple(1.02 * edge), rpy=(0.0, -1.5, 0.0))
    with pytest.raises(InputError, match=r"misses it by 0\.\d{4} m and [0-3]\.\d{4} rad|out of"):
        joints_of(one, entry)


def test_a_tool_direction_of_an_arm_without_closed_form():
    one = placed("ur5")
    entry = PostureEntry(position=(0.5, 0.4, 0.5), tool="down")
    q, missed = joints_of(one, entry)
    assert missed == 0.0
    pose = world(one, q)
    assert pose[:3, 3] == pytest.approx([0.5, 0.4, 0.5], abs=1e-5)
    last = one.arm.fk(q)[:3, :3].T @ one.arm.jacobian(q)[3:, -1]
    assert last == pytest.approx([0, 0, 1], abs=1e-9)
    assert pose[:3, 2] == pytest.approx([0, 0, -1], abs=1e-5)


def test_quaternion_and_angles_say_the_same():
    one = placed("panda")
    x, y, z, w = pin.Quaternion(pin.rpy.rpyToMatrix(0.3, -0.2, 1.0)).coeffs()
    same = PostureEntry(position=(0, 0, 0), quaternion=(x, y, z, w)).rotation
    assert same == pytest.approx(PostureEntry(position=(0, 0, 0), rpy=(0.3, -0.2, 1.0)).rotation)
    assert one.arm.nq == 7


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"rpy": (0, 0, 0), "tool": "down"}, "one of rpy, quaternion and tool"),
        ({"free": "z"}, "free with rpy or quaternion"),
        ({"quaternion": (0, 0, 0, 2.0)}, "a quaternion of length one"),
        ({"rpy": (0, 0, 0), "best_effort": True}, "best_effort without rpy"),
    ],
)
def test_fields_that_contradict_each_other(fields, message):
    with pytest.raises(ValueError, match=message):
        PostureEntry(position=(0, 0, 0), **fields)
