"""Lengths and bending of a motion, against sums and circles worked out apart."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arena.case import Case
from dualarm_repro.arena.judged import LAST_PIECE, SPACING, completed, evaluations_of, measures
from dualarm_repro.arms import load_arm
from dualarm_repro.scene import JointPath, PlacedArm, Scene

ARM = load_arm("irb120")
STILL = np.zeros(6)


@pytest.fixture(scope="module")
def case():
    arms = [
        PlacedArm(name, ARM, pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, turn), np.array([x, 0.0, 0.0])))
        for name, x, turn in (("left", 0.0, 0.0), ("right", 1.5, 2.0))
    ]
    ends = {"left": np.full(6, 0.4), "right": STILL}
    return Case("two", Scene(arms), dict.fromkeys(ends, STILL), ends)


def test_lengths_are_sums_over_the_steps_of_all_arms(case):
    rows = np.random.default_rng(3).uniform(-0.5, 0.5, (5, 6))
    other = 0.3 * rows[::-1]
    found = measures(case, {"left": JointPath(rows), "right": JointPath(other)})
    both = np.hstack([rows, other])
    assert found["joint_length"] == pytest.approx(
        sum(np.linalg.norm(b - a) for a, b in pairwise(both))
    )
    tool = 0.0
    for path in (rows, other):  # lengths do not depend on where an arm stands
        tips = [ARM.fk(q)[:3, 3] for q in path]
        tool += sum(np.linalg.norm(b - a) for a, b in pairwise(tips))
    assert found["tool_length"] == pytest.approx(tool)


def test_an_arm_that_waits_is_met_at_its_own_times(case):
    """The right arm moves only while the left one rests: the lengths add up."""
    first = JointPath([STILL, np.full(6, 0.4), np.full(6, 0.4)], [0.0, 1.0, 2.0])
    second = JointPath([STILL, STILL, np.full(6, 0.2)], [0.0, 1.0, 2.0])
    found = measures(case, {"left": first, "right": second})
    assert found["joint_length"] == pytest.approx(0.6 * np.sqrt(6))
    at_once = JointPath([STILL, np.full(6, 0.2)], [0.0, 1.0])
    found = measures(case, {"left": first, "right": at_once})
    assert found["joint_length"] == pytest.approx(np.sqrt(6) * np.hypot(0.4, 0.2))


@pytest.mark.parametrize("radius", [0.4, 0.8])
def test_the_bending_of_a_circle_is_its_squared_curvature(case, radius):
    turn = np.linspace(0.0, np.pi, 400)
    rows = np.zeros((400, 6))
    rows[:, 0], rows[:, 3] = radius * (1.0 - np.cos(turn)), radius * np.sin(turn)
    found = measures(case, {"left": JointPath(rows), "right": JointPath([STILL])})
    # chords of 0.05 rad in a circle of this radius
    assert found["bending"] == pytest.approx(radius**-2, rel=0.01)
    assert found["joint_length"] == pytest.approx(np.pi * radius, rel=1e-4)


def test_what_hardly_moves_has_no_bending(case):
    short = JointPath([STILL, np.array([3.9 * SPACING, 0, 0, 0, 0, 0])])
    found = measures(case, {"left": short, "right": JointPath([STILL])})
    assert np.isnan(found["bending"])
    longer = JointPath([STILL, np.array([4.1 * SPACING, 0, 0, 0, 0, 0])])
    assert measures(case, {"left": longer, "right": JointPath([STILL])})["bending"] == (
        pytest.approx(0.0, abs=1e-9)
    )


@pytest.mark.parametrize(("away", "rows"), [(0.9, 3), (1.1, 2), (0.0, 2)])
def test_a_path_is_completed_only_from_near_its_goal(case, away, rows):
    goal = case.goals["left"]
    last = goal.copy()
    last[2] -= away * LAST_PIECE
    path = JointPath([STILL, last], [0.0, 4.0])
    made = completed(case, {"left": path})["left"]
    assert len(made.configurations) == rows
    np.testing.assert_array_equal(made.configurations[:2], path.configurations)
    if rows == 3:
        np.testing.assert_array_equal(made.configurations[-1], goal)
        assert made.index.tolist() == [0.0, 4.0, 5.0]
    else:
        assert made is path


def test_evaluations_are_counted_once_or_one_a_step():
    counted = SimpleNamespace(plans={k: SimpleNamespace(evaluations=70, steps=3) for k in "ab"})
    assert evaluations_of(counted) == 70, "all arms together are counted by each"
    steps = {"a": SimpleNamespace(steps=3), "b": SimpleNamespace(steps=10)}
    assert evaluations_of(SimpleNamespace(plans=steps)) == 15
    unknown = {"a": SimpleNamespace(evaluations=None, steps=4)}
    assert evaluations_of(SimpleNamespace(plans=unknown)) == 5
