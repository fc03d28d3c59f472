"""Frames of a table, other tables of the same arm, and arms that differ from their file."""

import numpy as np
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.altered import altered
from dualarm_repro.arms.link_chains import (
    coinciding,
    frames_at_zero,
    modified_chain,
    offset_chain,
)
from dualarm_repro.arms.robot_file import load_robot_file
from dualarm_repro.datafiles import data_path


def test_frames_end_at_the_flange_and_the_wrist_shares_an_origin():
    arm = load_arm("irb120")
    frames = frames_at_zero(arm)
    assert frames[-1] == pytest.approx(arm.fk(np.zeros(6)), abs=1e-12)
    assert coinciding(frames[1:]) == [[4, 5]]


def test_a_planar_arm_by_offsets_and_by_a_modified_table():
    q = np.array([0.3, 0.5, 0.0])
    steps = [((0, 0, 0), "z"), ((0.4, 0, 0), "z"), ((0.2, 0, 0), "z")]
    rows = [(0.0, 0.0, 0.0, 0.3), (0.0, 0.4, 0.0, 0.5), (0.0, 0.2, 0.1, 0.0)]
    x, y = 0.4 * np.cos(0.3) + 0.2 * np.cos(0.8), 0.4 * np.sin(0.3) + 0.2 * np.sin(0.8)
    assert offset_chain(steps, q).translation == pytest.approx([x, y, 0.0])
    assert modified_chain(rows).translation == pytest.approx([x, y, 0.1])


def test_an_altered_arm():
    robot = load_robot_file(data_path("robots", "irb120.yaml"))
    arm, q = load_arm("irb120"), np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
    longer = altered("irb120", robot, 0.03)
    pose = arm.fk(q)
    assert longer.positions(q) == pytest.approx(pose[:3, 3] + 0.03 * pose[:3, 2])
    thin = altered("irb120", robot, 0.0, [0.01] * len(robot.capsules))
    assert {g.geometry.radius for g in thin.geometry.geometryObjects} == {0.01}
    assert thin.name != longer.name
