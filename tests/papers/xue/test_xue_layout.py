"""Printed inputs, the arrangement, and postures of the slave."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.papers.xue.document import (
    arms_of,
    gains,
    master_goal,
    master_start,
    placed_slave,
    posture,
    slave_end,
    slave_start,
    workspace_points,
)
from dualarm_repro.papers.xue.reading import nominal

SLAVE = arms_of("matrices")[1]


def test_inputs_are_those_of_print(registry):
    """The one copy of the numbers beside the ledger."""
    np.testing.assert_array_equal(master_start(), np.zeros(6))
    goal = np.pi * np.array([-1 / 2, -1 / 8, -1 / 2, 1 / 2, 1 / 4, 0])
    np.testing.assert_allclose(master_goal(), goal, rtol=1e-15)
    assert slave_start().tolist() == [0.75, 0.35, 0.5]
    assert slave_end().tolist() == [-0.45, 0.8, 0.15]
    assert gains() == {"k_a": 3.0, "k_w": 2.0, "k_r": 1.0, "d_0": 0.3}
    assert workspace_points() == 100_000


def test_slave_starts_and_ends_where_printed(registry):
    slave = placed_slave(nominal().layout)
    for q, point in ((slave.start, slave_start()), (slave.goal, slave_end())):
        reached = slave.placement.act(slave.arm.fk(q)[:3, 3])
        np.testing.assert_allclose(reached, point, atol=1e-12)


@given(
    st.floats(0.6, 1.8), st.floats(-np.pi, np.pi), st.floats(-0.6, 1.0),
    st.sampled_from(["radial_horizontal", "tool_down", "nearest_branch"]),
)  # fmt: skip
def test_posture_reaches_the_point_with_the_tool_as_asked(radius, azimuth, height, choice):
    point = np.array([radius * np.cos(azimuth), radius * np.sin(azimuth), height])
    q = posture(SLAVE, point, choice)
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


def test_posture_out_of_reach_is_none():
    assert posture(SLAVE, np.array([3.0, 0.0, 0.0]), "radial_horizontal") is None


def test_far_base_leaves_no_slave(registry):
    assert placed_slave(replace(nominal().layout, base_distance=9.0)) is None


@pytest.mark.parametrize("normal", ["x", "y", "chord"])
def test_window_has_the_opening_asked_for(registry, normal):
    layout = replace(nominal().layout, window_normal=normal)
    top, bottom, left, right = layout.window()
    vertical = np.linalg.norm(top.center - bottom.center) - top.size[1]
    across = np.linalg.norm(left.center - right.center) - left.size[0]
    assert vertical == pytest.approx(layout.window_opening_height)
    assert across == pytest.approx(layout.window_opening_width)
    np.testing.assert_allclose(0.5 * (top.center + bottom.center), layout.window_centre)
