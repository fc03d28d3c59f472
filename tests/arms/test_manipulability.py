"""Manipulability: closed form, invariances, scaling, accuracy near singularities."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.robot_file import load_robot_file
from dualarm_repro.datafiles import data_path

ANGLES = st.lists(st.floats(-3, 3), min_size=6, max_size=6)


def closed_form(arm, robot, q):
    """|det J| = a2 L |sin phi| rho |sin q5|; elbow angle phi, wrist at rho from axis 1."""
    a2, a3, d4 = robot.joints[2].a, robot.joints[3].a, robot.joints[3].d
    points = arm.joint_positions(q)
    wrist, elbow, shoulder = points[:, 4], points[:, 2], points[:, 1]
    upper, fore = elbow - shoulder, wrist - elbow
    sine = np.linalg.norm(np.cross(upper, fore), axis=1) / (a2 * np.hypot(a3, d4))
    rho = np.hypot(wrist[:, 0], wrist[:, 1])
    return a2 * np.hypot(a3, d4) * sine * rho * np.abs(np.sin(q[:, 4]))


@pytest.mark.parametrize("name", ["er16", "er20-1780", "kr16-2", "irb2400", "es165d"])
def test_closed_form(name, rng):
    arm = load_arm(name)
    q = arm.random_configurations(2000, rng)
    w = arm.manipulability(q)
    robot = load_robot_file(data_path("robots", f"{name}.yaml"))
    assert_allclose(w, closed_form(arm, robot, q), atol=1e-12)
    assert_allclose(w, [arm.manipulability(row) for row in q], atol=1e-12)
    assert_allclose(w, np.abs(np.linalg.det(arm.jacobian(q))), atol=1e-12)


@given(ANGLES, st.tuples(*[st.floats(-3, 3)] * 3))
def test_free_of_q1_q4_q6_for_a_spherical_wrist(q, others):
    arm = load_arm("kr16-2")
    turned = np.array(q)
    turned[[0, 3, 5]] = others
    assert arm.manipulability(turned) == pytest.approx(arm.manipulability(q), abs=1e-12)


@given(st.lists(st.floats(-2, 2), min_size=7, max_size=7), st.floats(-2, 2))
def test_free_of_q1_for_a_redundant_arm(q, turn):
    arm = load_arm("panda")
    turned = [q[0] + turn, *q[1:]]
    assert arm.manipulability(turned) == pytest.approx(arm.manipulability(q), abs=1e-12)


@given(ANGLES, st.floats(0.1, 10))
def test_scales_with_the_cube_of_the_lengths(q, scale):
    robot = load_robot_file(data_path("robots", "er16.yaml"))
    joints = [j.model_copy(update={"a": scale * j.a, "d": scale * j.d}) for j in robot.joints]
    arm = load_arm("er16")
    scaled = type(arm).from_dh("scaled", robot.model_copy(update={"joints": joints}))
    w = arm.manipulability([q])[0]
    assert scaled.manipulability([q])[0] == pytest.approx(scale**3 * w, rel=1e-9, abs=1e-11)


def test_small_values_keep_their_digits():
    """w is linear in a small sin q5; the root of det(J J^T) would end at 1e-8."""
    arm = load_arm("irb2400")
    q = np.array([[0.3, 0.2, 0.4, 0.5, angle, 0.1] for angle in (1e-3, 1e-6, 1e-9, 1e-12)])
    w = arm.manipulability(q)
    assert_allclose(w / np.sin(q[:, 4]), w[0] / np.sin(1e-3) * np.ones(4), rtol=1e-3)
    assert arm.manipulability(np.zeros(6)) == pytest.approx(0.0, abs=1e-15)


def test_fewer_than_six_joints_give_zero(two_links):
    arm = load_arm(two_links())
    assert arm.jacobian([0.1, 0.2, 0.3]).shape == (6, 3)
    assert arm.manipulability([[0.1, 0.2, 0.3]])[0] == pytest.approx(0.0, abs=1e-12)
