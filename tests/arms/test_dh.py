"""Both Denavit-Hartenberg conventions by matrices of numpy, and what a table promises."""

import numpy as np
import pinocchio as pin
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arms.dh import forward_kinematics, joint_symbols, link_transforms
from dualarm_repro.arms.dh_model import build_model
from dualarm_repro.arms.robot_file import DHRobot

ORIGIN = {"source": "test", "evidence": "assumed"}
COLUMNS = ("alpha", "a", "d", "offset", "lower", "upper", "velocity")


def robot(convention, rows, flange=None):
    """A table of rows (alpha, a, d, offset)."""
    joints = [
        {
            "name": f"j{k}",
            **dict(zip(("alpha", "a", "d", "offset"), map(float, row), strict=True)),
            "lower": -2.0,
            "upper": 2.5,
            "velocity": 3.0,
        }
        for k, row in enumerate(rows)
    ]
    return DHRobot(
        kind="dh",
        title="a table",
        evidence="made up",
        sources={"test": "made up"},
        convention=convention,
        joints=joints,
        flange=flange,
        provenance=dict.fromkeys(COLUMNS, ORIGIN),
    )


def about_x(angle, a):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1, 0, 0, a], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1.0]])


def about_z(angle, d):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, d], [0, 0, 0, 1.0]])


def by_matrices(convention, rows, q):
    pose = np.eye(4)
    for (alpha, a, d, offset), angle in zip(rows, q, strict=True):
        x, z = about_x(alpha, a), about_z(angle + offset, d)
        pose = pose @ (x @ z if convention == "modified" else z @ x)
    return pose


def flange_of(made, q):
    """By Pinocchio on the model of a table: code for every drawn one would have to be compiled."""
    model = build_model(made, "a")
    data = model.createData()
    pin.framesForwardKinematics(model, data, q)
    return data.oMf[model.getFrameId("flange")].homogeneous


NUMBERS = st.floats(-2.0, 2.0).map(lambda value: round(value, 6))
ROWS = st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS), min_size=1, max_size=7)


@pytest.mark.parametrize("convention", ["modified", "standard"])
@settings(max_examples=25)
@given(rows=ROWS, seed=st.integers(0, 10**6))
def test_an_arm_is_the_product_of_its_rows(convention, rows, seed):
    q = np.random.default_rng(seed).uniform(-3, 3, len(rows))
    found = flange_of(robot(convention, rows), q)
    np.testing.assert_allclose(found, by_matrices(convention, rows, q), atol=1e-12)


@pytest.mark.parametrize("convention", ["modified", "standard"])
def test_exact_transforms_are_the_rows_one_by_one(convention):
    rows = [(0.5, 0.3, -0.2, 0.1), (-1.0, 0.0, 0.4, 0.0)]
    made, q = link_transforms(robot(convention, rows)), [0.3, -0.7]
    for k, matrix in enumerate(made):
        found = np.array(matrix.subs(joint_symbols(2)[k], q[k]).evalf(), dtype=float)
        expected = by_matrices(convention, rows[k : k + 1], q[k : k + 1])
        np.testing.assert_allclose(found, expected, atol=1e-12)


def test_angles_and_lengths_stay_exact():
    made = robot("modified", [(0, 0.1, 0.2, 0)])
    matrix = link_transforms(made.model_copy())[0]
    assert matrix[0, 3] == sp.Rational(1, 10)
    assert matrix[2, 3] == sp.Rational(1, 5)
    assert not matrix.has(sp.Float)


def test_a_flange_turns_roll_then_pitch_then_yaw():
    """R = Rz(yaw) Ry(pitch) Rx(roll): roll and yaw of a right angle send x to y, y to z."""
    flange = {"translation": [0.1, 0.2, 0.3], "rpy": ["pi/2", 0, "pi/2"], **ORIGIN}
    made = robot("modified", [(0, 0, 0, 0)], flange)
    expected = np.array([[0, 0, 1, 0.1], [1, 0, 0, 0.2], [0, 1, 0, 0.3], [0, 0, 0, 1.0]])
    np.testing.assert_allclose(flange_of(made, np.zeros(1)), expected, atol=1e-12)
    exact = np.array(forward_kinematics(made).subs(joint_symbols(1)[0], 0), dtype=float)
    np.testing.assert_allclose(exact, expected, atol=1e-12)


def test_a_model_has_the_limits_speeds_and_names_of_its_table():
    model = build_model(robot("standard", [(0, 0, 0.1, 0), (1.0, 0.2, 0, 0)]), "twin")
    assert model.name == "twin"
    assert list(model.names)[1:] == ["j0", "j1"]
    assert model.lowerPositionLimit.tolist() == [-2.0, -2.0]
    assert model.upperPositionLimit.tolist() == [2.5, 2.5]
    assert model.upperVelocityLimit.tolist() == [3.0, 3.0]
    assert model.frames[model.getFrameId("flange")].parentJoint == 2


@settings(max_examples=20)
@given(rows=ROWS, seed=st.integers(0, 10**6))
def test_the_mirror_image_of_a_table_is_the_mirror_image_of_the_arm(rows, seed):
    made = robot("modified", rows)
    q = np.random.default_rng(seed).uniform(-3, 3, len(rows))
    mirror = np.diag([1.0, -1.0, 1.0, 1.0])
    found = flange_of(made.mirrored(), -q)
    np.testing.assert_allclose(found, mirror @ flange_of(made, q) @ mirror, atol=1e-12)
    assert [float(joint.lower) for joint in made.mirrored().joints] == [-2.5] * len(rows)
    assert flange_of(made.mirrored().mirrored(), q).tolist() == flange_of(made, q).tolist()
