"""Postures that bring the flange to a point, with the tool as a rule asks."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.tool_postures import tool_posture

SLAVE = load_arm("es165d-slave")


@given(
    st.floats(0.6, 1.8), st.floats(-np.pi, np.pi), st.floats(-0.6, 1.0),
    st.sampled_from(["radial_horizontal", "tool_down", "nearest_branch"]),
)  # fmt: skip
def test_posture_reaches_the_point_with_the_tool_as_asked(radius, azimuth, height, choice):
    point = np.array([radius * np.cos(azimuth), radius * np.sin(azimuth), height])
    q = tool_posture(SLAVE, point, choice)
    if q is None:
        return
    pose = SLAVE.fk(q)
    np.testing.assert_allclose(pose[:3, 3], point, atol=1e-9)
    level = np.array([point[0], point[1], 0.0]) / radius
    wanted = np.array([0.0, 0.0, -1.0]) if choice == "tool_down" else level
    np.testing.assert_allclose(pose[:3, 2], wanted, atol=1e-9)
    assert q[5] == 0.0
    if choice != "nearest_branch":
        assert abs(q[3]) <= 0.5 * np.pi + 1e-9


class TwoBranches:
    """An arm whose inverse has two branches: the higher with theta_4 as given, the lower with 0."""

    nq = 6

    def __init__(self, angle):
        self.found = np.zeros((1, 2, 6))
        self.found[0, 0, 3] = angle

    def ik_branches(self, poses, reference, within_limits):
        return self.found.copy()

    def joint_positions(self, q):
        heights = np.where(q[:, 3] != 0.0, 2.0, 1.0)
        return np.broadcast_to(heights[:, None, None], (len(q), 6, 3))


@pytest.mark.parametrize(("beyond", "taken"), [(0.0, 0), (1e-8, 1), (-1e-8, 0)])
def test_the_forearm_turns_by_a_right_angle_at_most(beyond, taken):
    arm = TwoBranches(0.5 * np.pi + beyond)
    q = tool_posture(arm, np.array([1.0, 0.0, 0.5]), "radial_horizontal")
    np.testing.assert_array_equal(q, arm.found[0, taken])


def test_posture_out_of_reach_is_none():
    assert tool_posture(SLAVE, np.array([3.0, 0.0, 0.0]), "radial_horizontal") is None
