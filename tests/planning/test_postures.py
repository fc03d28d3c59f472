"""Postures from positions: flange and tool are as asked, and the branch is the wanted one."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st
from window_scene import MASTER, SLAVE

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import InputError
from dualarm_repro.planning import posture
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.scene import PlacedArm

SMALL = PlacedArm(
    "small", load_arm("irb120"), pin.SE3(pin.rpy.rpyToMatrix(0, 0, 1.0), np.array([0.2, -0.3, 0.1]))
)
UP = np.array([0.0, 0.0, 1.0])


def tool_axis(placed, q):
    """Axis of the last joint in the world."""
    pose = placed.placement.homogeneous @ placed.arm.fk(q)
    return pose[:3, :3] @ placed.arm.chain.rotation[-1].T[:, 2]


@pytest.mark.parametrize("placed", [MASTER, SLAVE, SMALL])
@given(st.floats(-2.5, 2.5), st.floats(0.4, 0.6), st.floats(0.1, 0.3), st.floats(-3, 3))
def test_flange_and_tool_are_where_they_were_asked_for(placed, azimuth, out, height, last):
    reach = np.linalg.norm(placed.arm.chain.translation[1:], axis=1).sum()
    local = reach * np.array([out * np.cos(azimuth), out * np.sin(azimuth), height])
    point = placed.placement.act(local)
    q = posture(placed, point, "radial", last_joint=last)
    assert end_effector(placed, q) == pytest.approx(point, abs=1e-9)
    radial = placed.placement.rotation @ (local * [1, 1, 0])
    assert tool_axis(placed, q) == pytest.approx(radial / np.linalg.norm(radial), abs=1e-9)
    assert q[-1] == last


@pytest.mark.parametrize("tool", ["down", (0.3, -0.5, 0.4)])
def test_other_directions(tool):
    point = SMALL.placement.act(np.array([0.3, 0.1, 0.3]))
    axis = -UP if tool == "down" else np.array(tool) / np.linalg.norm(tool)
    q = posture(SMALL, point, tool)
    assert tool_axis(SMALL, q) == pytest.approx(axis, abs=1e-9)


def test_elbow_up_and_down():
    point = (0.75, 0.35, 0.5)
    heights = [
        SLAVE.arm.joint_positions(posture(SLAVE, point, "radial", elbow=elbow))[2, 2]
        for elbow in ("up", "down")
    ]
    assert heights[0] > heights[1] + 0.1


def test_of_all_branches_the_one_nearest_to_the_reference():
    point = (0.75, 0.35, 0.5)
    first = posture(SLAVE, point, "radial")
    far = posture(SLAVE, point, "radial", reference=first + np.pi * np.eye(6)[3])
    assert abs(far[3] - first[3]) == pytest.approx(np.pi)
    assert np.abs(posture(SLAVE, point, "radial", reference=first) - first).max() < 1e-12


@pytest.mark.parametrize(
    ("placed", "point", "tool", "field", "expected"),
    [
        (SMALL, (0.2, -0.3, 1.152), (0, 0, 1), "position", r"out of reach by 0\.1100 m"),
        (
            SMALL,
            SMALL.placement.act(np.array([0.0, 0.0, 0.941])),
            (1, 0, 0),
            "tool",
            "turn its tool",
        ),
        (SLAVE, (np.nan, 0, 0), "radial", "position", "three finite numbers"),
        (SLAVE, (0.75, 0.35, 0.5), (0, 0, 0), "tool", "not zero"),
    ],
)
def test_what_cannot_be_is_said(placed, point, tool, field, expected):
    with pytest.raises(InputError, match=expected) as caught:
        posture(placed, point, tool)
    assert (caught.value.source, caught.value.field) == (f"arm {placed.name}", field)
