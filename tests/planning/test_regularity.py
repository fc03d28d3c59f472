"""Singular postures on a path, and straight lines of the flange that inverse kinematics follows."""

import numpy as np
import pytest

from dualarm_repro import load_arm
from dualarm_repro.planning.checks.regularity import (
    Line,
    crosses_singularity,
    follow_line,
    least_singular_value,
)

ARM = load_arm("irb120")
BENT = np.array([0.3, 0.2, -0.4, 0.2, 0.9, 0.1])


def line(start, end, count=50):
    return np.linspace(start, end, count)


def test_the_least_singular_value_is_that_of_the_worst_posture():
    path = line(BENT, np.zeros(6))
    each = [np.linalg.svd(ARM.jacobian(q)[:3], compute_uv=False)[-1] for q in path]
    assert least_singular_value(ARM, path) == pytest.approx(min(each))


def test_a_wrist_that_bends_the_other_way_crosses_a_singular_pose():
    other = BENT * [1, 1, 1, 1, -1, 1]
    assert crosses_singularity(ARM, line(BENT, other))
    assert not crosses_singularity(ARM, line(BENT, BENT + 0.1))


def test_round_off_at_a_singular_start_is_no_crossing():
    assert not crosses_singularity(ARM, line(np.zeros(6), BENT))


def test_a_short_line_is_followed():
    assert follow_line(ARM, BENT, BENT + 0.05) is Line.FOLLOWED


def test_a_line_past_the_straight_arm_is_lost():
    start, goal = [0.8, -1.1, -1.0, 0.0, -1.1, -0.7], [0.9, 1.2, 0.8, -0.8, 0.7, 0.2]
    assert follow_line(ARM, start, goal) is Line.STRETCHED


def test_a_line_to_an_aligned_wrist_jumps():
    """Where axes 4 and 6 come into line, joint 4 has to turn at once."""
    start, goal = [-0.4, 0.7, -0.5, -0.1, -0.9, -0.2], [-0.7, -0.6, 0.6, -0.5, 0.0, 1.2]
    assert follow_line(ARM, start, goal) is Line.JUMP
