"""Postures of an elbow arm by branch, its shoulder and its reach."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import UnsupportedArmError
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.planning.tasks.elbow_branches import (
    BRANCHES,
    branch_posture,
    elbow_lengths,
    pulled_back,
    shoulder,
    straight_reach,
    wrist_reach,
)
from dualarm_repro.scene import PlacedArm

ARM = PlacedArm(
    "master", load_arm("irb120"), pin.SE3(pin.utils.rotate("z", 1.2), np.array([0.35, 0.1, 0.2]))
)


@given(
    direction=st.lists(st.floats(-1, 1), min_size=3, max_size=3).filter(
        lambda v: np.linalg.norm(v) > 0.1 and np.hypot(v[0], v[1]) > 0.05
    ),
    radius=st.floats(0.2, 0.64),
    roll=st.floats(-3.0, 3.0),
    bend=st.floats(-1.0, 1.0),
)
def test_branch_postures_reach_their_point(direction, radius, roll, bend):
    point = shoulder(ARM) + radius * np.array(direction) / np.linalg.norm(direction)
    found = [branch_posture(ARM, point, branch, (roll, bend, 0.3)) for branch in BRANCHES]
    for q in found:
        if q is not None:
            assert end_effector(ARM, q) == pytest.approx(point, abs=1e-9)
            assert q[3:] == pytest.approx([roll, bend, 0.3])
    assert bend != 0.0 or all(q is not None for q in found)


def test_reach_is_attained_and_never_passed():
    reach, size = straight_reach(ARM.arm), elbow_lengths(ARM.arm)
    lag = np.arctan2(size.a3, size.d4)
    q = np.array([0.0, 0.4, lag - np.pi / 2, 0.0, -lag, 0.0])
    assert np.linalg.norm(end_effector(ARM, q) - shoulder(ARM)) == pytest.approx(reach, abs=1e-12)
    rows = ARM.arm.random_configurations(2000, np.random.default_rng(1))
    assert np.linalg.norm(end_effector(ARM, rows) - shoulder(ARM), axis=1).max() <= reach + 1e-12
    assert wrist_reach(ARM.arm, (0.0, -lag, 0.0)) == pytest.approx(reach, abs=1e-12)
    beyond = shoulder(ARM) + (reach + 1e-6) * np.array([0.6, 0.0, 0.8])
    assert branch_posture(ARM, beyond, "front_shallow") is None


def test_pulled_back_point_is_on_the_ray():
    point = np.array([0.1, 0.6, 0.9])
    ray = pulled_back(ARM, point, 0.63) - shoulder(ARM)
    assert np.linalg.norm(ray) == pytest.approx(0.63)
    assert np.cross(ray, point - shoulder(ARM)) == pytest.approx(np.zeros(3), abs=1e-12)


def test_another_kind_of_arm_is_refused():
    with pytest.raises(UnsupportedArmError, match="elbow arm"):
        elbow_lengths(load_arm("es165d"))
