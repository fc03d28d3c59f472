"""Forward kinematics and Jacobian: sympy, Pinocchio and the batch kernels agree."""

import numpy as np
import pinocchio as pin
import pytest
import sympy as sp
from example_robot_data import getModelPath
from hypothesis import given
from hypothesis import strategies as st
from long_tests import long_where
from numpy.testing import assert_allclose

from dualarm_repro.arms import arm_names, load_arm
from dualarm_repro.arms.dh import joint_symbols
from dualarm_repro.arms.robot_file import DHRobot, load_robot_file
from dualarm_repro.datafiles import data_path

DH_ARMS = [
    name
    for name in arm_names()
    if isinstance(load_robot_file(data_path("robots", f"{name}.yaml")), DHRobot)
]
XARM7 = "xarm_description/urdf/xarm7.urdf"


def any_arm(name):
    return load_arm(f"{getModelPath(name)}/{name}" if name.endswith(".urdf") else name)


@pytest.mark.parametrize("name", [*DH_ARMS, "es165d-slave"])
def test_symbols_pinocchio_and_kernels_agree(name, rng):
    arm = load_arm(name)
    symbolic = sp.lambdify([joint_symbols(6)], arm.symbolic_fk(), "numpy", cse=True)
    q = rng.uniform(-7, 7, (40, 6))
    exact = np.array([symbolic(row) for row in q])
    assert_allclose(arm.fk(q), exact, atol=1e-12)
    assert_allclose([arm.fk(row) for row in q], exact, atol=1e-12)


@pytest.mark.parametrize("name", ["es165d", "irb120"])
def test_link_transforms_multiply_to_the_pose(name):
    arm = load_arm(name)
    product = sp.eye(4)
    for transform in arm.link_transforms():
        product = product * transform
    difference = (product - arm.symbolic_fk()).applyfunc(sp.expand)
    assert difference == sp.zeros(4, 4)
    assert not arm.symbolic_fk().has(sp.Float), "lengths and angles stay exact"


@pytest.mark.parametrize(
    "name",
    long_where(XARM7.__eq__, ["es165d", "irb120", "er16", "kr16-2", "irb2400", "panda", XARM7]),
)
def test_kernels_agree_with_pinocchio_on_many_configurations(name, rng):
    arm = any_arm(name)
    q = rng.uniform(-2 * np.pi, 2 * np.pi, (10_000, arm.nq))
    data, frame = arm.model.createData(), pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    T, J, origins = np.empty((len(q), 4, 4)), np.empty((len(q), 6, arm.nq)), []
    for k, row in enumerate(q):
        J[k] = pin.computeFrameJacobian(arm.model, data, row, arm.flange_id, frame)
        T[k] = pin.updateFramePlacement(arm.model, data, arm.flange_id).homogeneous
        origins.append([data.oMi[i].translation.copy() for i in range(1, arm.nq + 1)])
    assert_allclose(arm.fk(q), T, atol=1e-12)
    assert_allclose(arm.jacobian(q), J, atol=1e-12)
    assert_allclose(arm.positions(q), T[:, :3, 3], atol=1e-12)
    assert_allclose(arm.joint_positions(q)[:, :-1], origins, atol=1e-12)
    assert_allclose(arm.joint_positions(q)[:, -1], T[:, :3, 3], atol=1e-12)
    assert_allclose(arm.manipulability(q), np.prod(np.linalg.svd(J)[1], axis=1), atol=1e-12)


@pytest.mark.parametrize("name", ["es165d", "irb120", "er16", "panda"])
def test_one_configuration_equals_a_batch_of_one(name, rng):
    arm = load_arm(name)
    q = arm.random_configurations(1, rng)
    for method in (arm.fk, arm.jacobian, arm.manipulability, arm.positions, arm.joint_positions):
        assert_allclose(method(q[0]), method(q)[0], atol=1e-13)
    assert arm.within_limits(q[0]) is True
    assert arm.within_limits(q).tolist() == [True]


@pytest.mark.parametrize("count", [0, 1, 63, 64, 65, 200])
def test_batches_of_any_length(count, rng):
    arm = load_arm("irb120")
    q = arm.random_configurations(count, rng)
    assert arm.fk(q).shape == (count, 4, 4)
    assert arm.jacobian(q).shape == (count, 6, 6)
    assert_allclose(arm.manipulability(q), [arm.manipulability(row) for row in q], atol=1e-13)


@pytest.mark.parametrize("name", ["es165d", "irb120", "er16", "panda"])
def test_jacobian_is_the_derivative(name, rng):
    arm, step = load_arm(name), 1e-6
    for q in arm.random_configurations(20, rng):
        numeric = np.empty((6, arm.nq))
        for j, direction in enumerate(step * np.eye(arm.nq)):
            plus, minus = arm.fk(q + direction), arm.fk(q - direction)
            numeric[:3, j] = (plus[:3, 3] - minus[:3, 3]) / (2 * step)
            numeric[3:, j] = pin.log3(plus[:3, :3] @ minus[:3, :3].T) / (2 * step)
        assert_allclose(arm.jacobian(q), numeric, atol=1e-7)


def test_lists_float32_and_strided_arrays_are_accepted(rng):
    arm = load_arm("irb120")
    q = arm.random_configurations(8, rng)
    wide = np.repeat(q, 2, axis=1)
    assert_allclose(arm.fk(q.tolist()), arm.fk(q), atol=0)
    assert_allclose(arm.fk(wide[:, ::2]), arm.fk(q), atol=0)
    assert_allclose(arm.fk(np.asfortranarray(q)), arm.fk(q), atol=0)
    assert_allclose(arm.fk(wide[0, ::2]), arm.fk(q[0]), atol=0)
    assert_allclose(arm.fk(q.astype(np.float32)), arm.fk(q), atol=1e-6)
    assert_allclose(arm.fk([0] * 6)[:3, 3], (0.374, 0.0, 0.630), atol=1e-15)


@given(st.lists(st.floats(-3, 3), min_size=6, max_size=6), st.floats(-3, 3))
def test_turning_joint_1_turns_the_base(q, turn):
    arm = load_arm("er16")
    turned = arm.fk([q[0] + turn, *q[1:]])
    assert_allclose(turned[:3], pin.rpy.rpyToMatrix(0, 0, turn) @ arm.fk(q)[:3], atol=1e-13)


@given(st.lists(st.floats(-3, 3), min_size=6, max_size=6))
def test_mirror_image(q):
    mirror = np.diag([1.0, -1.0, 1.0, 1.0])
    for name in ("es165d", "irb120"):
        arm = load_arm(name)
        slave = arm.mirrored()
        image = slave.fk(-np.array(q))
        assert_allclose(image, mirror @ arm.fk(q) @ mirror, atol=1e-13)
        assert_allclose(slave.lower, -arm.upper)
        assert_allclose(slave.upper, -arm.lower)
        assert_allclose(slave.mirrored().fk(q), arm.fk(q), atol=0)


@pytest.mark.parametrize("span", [1e6, 1e8, 1e16])
def test_after_many_turns(span, rng):
    """However often a joint has turned, a block of rows agrees with each row alone."""
    arm = load_arm("irb120")
    q = rng.uniform(-1.0, 1.0, (70, 6)) * span ** rng.uniform(0, 1, (70, 1))
    data, poses = arm.model.createData(), arm.fk(q)
    for row, pose in zip(q, poses, strict=True):
        pin.framesForwardKinematics(arm.model, data, row)
        assert_allclose(pose, data.oMf[arm.flange_id].homogeneous, rtol=0, atol=1e-12)
        assert_allclose(pose, arm.fk(row), rtol=0, atol=1e-12)
