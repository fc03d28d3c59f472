"""What `plan` gives away: every arm of the scene, the certified distance, and words for both."""

import json
from itertools import product

import numpy as np
import pytest

from dualarm_repro.planning import plan_file
from dualarm_repro.planning.checks.truth import Truth, truth
from dualarm_repro.view.plan_report import (
    judged,
    plan_page,
    plan_reached,
    plan_scene,
    plan_summary,
    remarks,
    told,
    usable,
)

#: An arm that turns aside, and one that is parked far from it.
APART = """
arms:
  left: {robot: irb120, xyz: [0, 0.6, 0], start: [0, 0.2, 0, 0, 0.3, 0], goal: [0.5, 0.2, 0, 0, 0.3, 0]}
  right: {robot: irb120, xyz: [0, -0.6, 0], start: [0, 0, 0, 0, 0, 0]}
"""  # noqa: E501


@pytest.fixture(scope="module")
def plan(tmp_path_factory):
    path = tmp_path_factory.mktemp("plan") / "apart.yaml"
    path.write_text(APART, encoding="utf-8")
    return plan_file(path, "attraction-only")


def truths(lower, upper, excess=0.0):
    return Truth(lower, upper, ("a/1", "b/2"), 3.5, {}, {"a": excess, "b": 0.0})


def test_a_summary_speaks_of_every_arm(plan):
    found = plan_summary(plan)
    assert list(found["arms"]) == ["left", "right"]
    left, right = found["arms"].values()
    assert (left["reached"], left["reason"]) == (True, "reached")
    assert (right["reason"], right["reached"], right["steps"]) == ("parked", True, 0)
    path = plan.plans["left"].path
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    assert left["steps"] == len(steps)
    assert left["joint_length_rad"] == pytest.approx(steps.sum())
    tips = np.array([plan.scene.arms[0].arm.fk(q)[:3, 3] for q in path])
    way = np.linalg.norm(np.diff(tips, axis=0), axis=1).sum()
    assert left["tcp_length_m"] == pytest.approx(way)
    assert left["out_of_reach_m"] == 0.0
    assert left["outside_limits"] == []
    assert found["reached"] is plan_reached(plan) is True
    json.dumps(found)


def test_the_distance_is_the_certified_bracket(plan):
    found, known = plan_summary(plan), truth(plan.scene, plan.paths)
    assert found["links"]["bracket_m"] == [known.lower, known.upper]
    assert found["links"]["minimum_distance_m"] == known.lower
    assert found["links"]["pair"] == list(known.pair)
    told_so = Truth(-0.2, -0.1, None, 0.0, {}, {"left": 0.3, "right": 0.0})
    other = plan_summary(plan, told_so)
    assert other["links"]["bracket_m"] == [-0.2, -0.1], "what is known already is not asked again"
    assert other["links"]["pair"] == []
    assert other["arms"]["left"]["beyond_limits"] == 0.3


@pytest.mark.parametrize(
    ("bounds", "verdict", "free"),
    [((0.01, 0.02), "certified free", True), ((-0.02, -0.01), "COLLISION", False),
     ((-0.01, 0.01), None, False), ((0.0, 0.01), None, False)],
)  # fmt: skip
def test_a_bracket_decides_only_if_it_lies_on_one_side(bounds, verdict, free):
    found = judged(truths(*bounds))["links"]
    assert found["collision_free"] is free
    if verdict:
        assert found["verdict"] == verdict
    else:
        assert found["verdict"] not in ("certified free", "COLLISION")
    assert found["step"] == 3.5


@pytest.mark.parametrize(
    ("reached", "begun", "excess", "lower"),
    list(product((True, False), (True, False), (0.0, 0.1), (0.01, -0.02))),
)
def test_everything_that_keeps_a_motion_from_being_run_is_told(reached, begun, excess, lower):
    found = truths(lower, lower + 0.005, excess)
    text = told(found, reached, begun)
    good = reached and begun and excess == 0.0 and lower > 0.0
    assert usable(found, reached, begun) is good
    assert ("not arrived" in text) is not reached
    assert ("not from the start" in text) is not begun
    assert ("beyond joint limits" in text) is (excess > 0.0)
    assert ("COLLISION" in text) is (lower < 0.0)
    assert (text == "arrived, certified free") is good


def test_remarks_are_those_of_arms_that_have_some(plan):
    assert remarks(plan.scene) == {
        one.name: list(one.arm.remarks) for one in plan.scene.arms if one.arm.remarks
    }


def test_a_page_shows_the_motion_of_the_plan(plan):
    made = plan_scene(plan, "Aside.")
    tips = made.contents.tips["left"]
    start, goal = (plan.scene.arms[0].placement.act(plan.scene.arms[0].arm.fk(q)[:3, 3])
                   for q in plan.plans["left"].path[[0, -1]])  # fmt: skip
    np.testing.assert_allclose(tips[[0, -1]], [start, goal], atol=1e-9)
    assert np.ptp(made.contents.tips["right"], axis=0).max() == 0.0
    assert 'class="ledger-scene"' in plan_page(plan, "Aside.").html
