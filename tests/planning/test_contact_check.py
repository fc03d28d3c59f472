"""Contact of whole links along a path, and the yardstick planner without its library."""

import sys

import numpy as np
import pytest
from two_spheres import GOAL, START, placed_arm, shapes

from dualarm_repro.errors import UnsupportedArmError
from dualarm_repro.planning.checks.contact_check import contact_check
from dualarm_repro.planning.search.rrt_connect import plan_rrt_connect
from dualarm_repro.scene import JointPath, Scene, Sphere, distances


def test_straight_line_hits_the_sphere_and_groups_are_told_apart():
    scene = Scene([placed_arm()], {"near": shapes()["near"]}, floor=0.0)
    line = np.linspace(START, GOAL, 3)
    check = contact_check(scene, line)
    assert set(check.clearance) == {"obstacles", "floor", "self"}
    assert check.clearance["obstacles"] < 0 < check.clearance["floor"]
    assert check.smallest == check.clearance["obstacles"]
    assert not check.free
    fine = distances(scene, np.linspace(START, GOAL, 2001)).min()
    # the check samples the line more coarsely [m]
    assert check.smallest == pytest.approx(fine, abs=2e-3)


def test_limits_and_free_path():
    scene = Scene([placed_arm()], {"away": Sphere([3, 3, 3], 0.1)})
    line = np.linspace(START, GOAL, 3)
    assert contact_check(scene, line).free
    beyond = contact_check(scene, line + np.array([0, 0, 1.5, 0, 0, 0]))
    assert beyond.beyond_limits == pytest.approx(1.5 - np.deg2rad(70))
    assert not beyond.free


def test_a_moving_arm_counts_as_arm():
    arm = placed_arm()
    other = type(arm)("other", arm.arm, arm.placement)
    scene = Scene([arm, other]).replaying("other", JointPath(np.zeros((3, 6))))
    check = contact_check(scene, np.linspace(START, GOAL, 3))
    assert check.clearance["arms"] < 0


def test_rrt_connect_says_what_it_needs(monkeypatch):
    monkeypatch.setitem(sys.modules, "ompl", None)
    with pytest.raises(UnsupportedArmError, match="bench"):
        plan_rrt_connect(Scene([placed_arm()]), START, GOAL, 1)
