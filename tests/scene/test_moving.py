import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import ConfigurationError, InputError
from dualarm_repro.scene import JointPath, MovingArm, PosePath
from examples import random_placement, seeds, thorough


def test_joint_path_is_linear_and_held_at_its_ends():
    path = JointPath([[0, 0], [1, 2], [1, 4]], index=[10, 20, 40])
    times = np.array([-5, 10, 15, 20, 30, 40, 99.0])
    expected = [[0, 0], [0, 0], [0.5, 1], [1, 2], [1, 3], [1, 4], [1, 4]]
    np.testing.assert_allclose(path.at(times), expected)


def test_default_index_counts_samples():
    path = JointPath([[0], [10], [30]])
    np.testing.assert_allclose(path.at(np.array([0.5, 1.5]))[:, 0], [5, 20])


def test_single_sample_is_a_parked_arm():
    path = JointPath([[1, 2]])
    np.testing.assert_array_equal(path.at(np.array([-1, 0, 7.0])), [[1, 2]] * 3)
    np.testing.assert_array_equal(path.travel(np.array([-1, 0, 7.0])), np.zeros((3, 2)))


def test_travel_adds_back_and_forth():
    path = JointPath([[0], [1], [-1]])
    np.testing.assert_allclose(path.travel(np.array([0, 0.5, 1, 2, 9.0]))[:, 0], [0, 0.5, 1, 3, 3])


@given(seeds)
@thorough
def test_pose_path_meets_its_samples_and_turns_evenly(seed):
    rng = np.random.default_rng(seed)
    poses = [random_placement(rng) for _ in range(4)]
    index = np.cumsum(rng.uniform(0.1, 1, 4))
    path = PosePath(poses, index)
    for pose, found in zip(poses, path.at(index), strict=True):
        np.testing.assert_allclose(found, pose.homogeneous[:3], atol=1e-9)
    third = path.at(np.array([index[1] + (index[2] - index[1]) / 3]))[0]
    straight = poses[1].translation + (poses[2].translation - poses[1].translation) / 3
    np.testing.assert_allclose(third[:, 3], straight, atol=1e-12)
    turn = pin.log3(poses[1].rotation.T @ poses[2].rotation)
    so_far = pin.log3(poses[1].rotation.T @ np.ascontiguousarray(third[:, :3]))
    np.testing.assert_allclose(so_far, turn / 3, atol=1e-6)


def test_pose_path_is_held_at_its_ends():
    first, last = pin.SE3.Identity(), pin.SE3(np.eye(3), np.array([1.0, 0, 0]))
    path = PosePath([first, last])
    found = path.at(np.array([-3, 0.25, 8.0]))[:, 0, 3]
    np.testing.assert_allclose(found, [0, 0.25, 1])
    np.testing.assert_allclose(PosePath([last]).at(np.array([5.0]))[0], last.homogeneous[:3])


def test_pose_travel_is_way_and_angle():
    turn = pin.rpy.rpyToMatrix(0, 0, 0.5)
    path = PosePath([pin.SE3.Identity(), pin.SE3(turn, np.array([3.0, 4, 0]))])
    np.testing.assert_allclose(path.travel(np.array([0.5, 1])), [[2.5, 0.25], [5, 0.5]])


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: JointPath([]), "JointPath: configurations"),
        (lambda: JointPath(np.empty((0, 6))), "JointPath: samples = 0: expected at least one"),
        (lambda: JointPath([1, 2]), r"JointPath: configurations.*joint vectors \(M, nq\)"),
        (lambda: JointPath([[1], [np.nan]]), "JointPath: configurations"),
        (lambda: JointPath([[1], [2]], [0, 0]), "JointPath: index.*increasing order"),
        (lambda: JointPath([[1], [2]], [0]), "JointPath: index.*2 finite numbers"),
        (lambda: JointPath([[1], [2]], [0, np.inf]), "JointPath: index"),
        (lambda: PosePath([]), "PosePath: samples = 0"),
        (lambda: PosePath([pin.SE3(np.eye(3), np.full(3, np.nan))]), "PosePath: poses"),
    ],
)
def test_bad_paths(build, message):
    with pytest.raises(InputError, match=message):
        build()


def test_path_of_another_arm_is_refused():
    with pytest.raises(ConfigurationError, match="irb120: shape of q"):
        MovingArm(load_arm("irb120"), JointPath(np.zeros((3, 7))))
