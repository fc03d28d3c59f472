"""Readings of `qiu`: postures, goals, settings of the variants."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from dualarm_repro.errors import InputError
from dualarm_repro.ledger import REGISTRY
from dualarm_repro.papers.qiu.document import PRINTED, arm_in_use, placed
from dualarm_repro.papers.qiu.reading import (
    CONTROL_POINTS,
    Goal,
    GoalBox,
    Improved,
    Links,
    Slave,
    SlaveGoal,
    Traditional,
    VariableGain,
)
from dualarm_repro.planning.checks.contact_check import ContactCheck
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.planning.search.variants import VARIANTS
from dualarm_repro.planning.tasks.elbow_branches import branch_posture
from dualarm_repro.scene.posing import links_of


def test_the_printed_goal_is_out_of_reach():
    assert branch_posture(placed("master"), PRINTED.master_goal, "front_shallow") is None


def test_every_choice_of_the_goal_has_a_posture():
    modes, branches, wrists = (
        REGISTRY.declared(f"qiu.{key}", "choices").choices
        for key in ("master_goal", "goal_branch", "goal_wrist")
    )
    radii = REGISTRY.declared("qiu.goal_radius", "range").range
    for mode, radius, branch, wrist in product(modes, radii, branches, wrists):
        assert np.isfinite(Goal(mode, radius, branch, tuple(wrist)).posture()).all()


def test_every_reading_of_the_goal():
    for mode in ("pulled_back", "longer_tool", "moved_base", "best_effort"):
        goal = Goal.nominal(master_goal=mode)
        tip = end_effector(goal.arm(), goal.posture())
        if mode in ("longer_tool", "moved_base"):
            assert tip == pytest.approx(PRINTED.master_goal, abs=1e-9)
        else:
            assert 0.02 < np.linalg.norm(tip - PRINTED.master_goal) < 0.05
        assert abs(goal.posture()[0] - np.deg2rad(114)) < 0.1


def test_slave_goal_has_one_posture_within_the_limits():
    arm, goal = placed("slave"), SlaveGoal.nominal()
    inside = [q for q in goal.slave_postures().values() if arm.arm.within_limits(q)]
    assert len(inside) == 1
    assert inside[0] == pytest.approx(goal.slave_posture())
    assert end_effector(arm, inside[0]) == pytest.approx(PRINTED.slave_goal, abs=1e-9)


def test_goals_are_seeded_and_keep_their_distance():
    box = GoalBox.nominal()
    one, two, other = (box.draw(seed) for seed in (1, 1, 2))
    assert (one.q == two.q).all()
    assert not np.allclose(one.q, other.q)
    centre = end_effector(box.arm(), box.posture())
    assert np.abs(one.points - centre).max() <= box.goal_set
    tips = end_effector(box.arm(), one.q)
    assert tips == pytest.approx(one.points, abs=1e-9)


def test_variants():
    reading = Improved.nominal()
    names = [variant.name for variant in VARIANTS]
    assert sorted(names) == sorted({"traditional", "V", "A", "B", "VA", "VB", "AB", "VAB"})
    for variant in VARIANTS:
        chosen = reading.settings(variant)
        assert chosen.two_sided == ("B" in variant.name)
        assert (chosen.variable_gain.rule == "constant") == ("V" not in variant.name)
        assert (chosen.step.rule == "constant") == ("A" not in variant.name)
    assert replace(reading, gain_ratio=1e-3).plan().searches != reading.plan().searches


def test_a_table_repels_the_search_and_counts_as_contact():
    without, told = Improved.nominal(), Improved.nominal(floor="at_bases")
    assert (without.truth().floor, told.truth().floor) == (None, 0.0)
    assert len(told.obstacles().planes) == len(without.obstacles().planes) + 1
    assert told.plan().tcp[:, 2].min() > without.plan().tcp[:, 2].min()


def test_limits_are_kept_on_the_way_to_a_goal_within_them():
    arm = placed("slave").arm
    for limits, kept in (("kept", True), ("ignored", False)):
        slave = Slave.nominal(limits=limits)
        inside, beyond = slave.slave_posture(), slave.slave_postures()["front_deep"]
        assert slave.settings(goal=inside).enforce_limits is kept
        assert not slave.settings(goal=beyond).enforce_limits
    plan = Slave.nominal().dual_plan()
    assert arm.within_limits(plan.slave_path).all()


def test_limits_decide_whether_a_plan_counts_only_if_they_are_kept():
    check = ContactCheck({"obstacles": 0.01}, beyond_limits=0.1)
    assert not Improved.nominal().is_free(check)
    assert Improved.nominal(limits="ignored").is_free(check)
    assert not Improved.nominal(limits="ignored").is_free(ContactCheck({"self": -0.01}, 0.0))


def test_the_wrists_of_both_arms_are_chosen_by_themselves():
    bent = Slave.nominal(slave_wrist=(0.0, 0.8, 0.0))
    assert bent.slave_posture()[4] == 0.8
    assert bent.posture()[4] == 0.0


def test_every_reading_has_its_variant():
    for reading, name in ((Traditional, "traditional"), (VariableGain, "V"), (Improved, "VAB")):
        made = reading.nominal()
        assert made.variant.name == name
        assert made.settings() == Improved.nominal().settings(made.variant)


def test_what_the_code_does_not_know_is_refused():
    with pytest.raises(InputError, match="step_rule"):
        Improved.nominal(step_rule="force")
    with pytest.raises(InputError, match="baseline"):
        Traditional.nominal(baseline="another")


@pytest.mark.parametrize("points", CONTROL_POINTS)
def test_every_set_of_control_points_has_a_radius_and_a_weight_for_each(points):
    chosen = Improved.nominal(control_points=points).settings()
    assert len(chosen.control_points) == len(chosen.radii) == len(chosen.step.weights)


def test_assumed_radii_are_those_of_the_robot():
    assert links_of(arm_in_use()).radius == pytest.approx(Links.nominal().radii)
    thin = Links.nominal(link_radius_scale=0.8).radii
    assert links_of(arm_in_use(radii=thin)).radius == pytest.approx(
        0.8 * np.array(Links.nominal().link_radii)
    )
