"""Readings of `qiu`: postures, goals, settings of the variants."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.errors import InputError
from dualarm_repro.ledger import REGISTRY
from dualarm_repro.papers.qiu.document import PRINTED, arm_in_use, placed, reach, shoulder
from dualarm_repro.papers.qiu.postures import BRANCHES, branch_posture, pulled_back
from dualarm_repro.papers.qiu.reading import (
    CONTROL_POINTS,
    VARIANTS,
    Goal,
    GoalBox,
    Improved,
    Links,
    SlaveGoal,
    Traditional,
    VariableGain,
    balance_ratio,
)
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.scene.posing import links_of


@given(
    direction=st.lists(st.floats(-1, 1), min_size=3, max_size=3).filter(
        lambda v: np.linalg.norm(v) > 0.1 and np.hypot(v[0], v[1]) > 0.05
    ),
    radius=st.floats(0.2, 0.64),
    roll=st.floats(-3.0, 3.0),
    bend=st.floats(-1.0, 1.0),
)
def test_branch_postures_reach_their_point(direction, radius, roll, bend):
    arm = placed("master")
    point = shoulder(arm.placement.translation) + radius * np.array(direction) / np.linalg.norm(
        direction
    )
    found = [branch_posture(arm, point, branch, (roll, bend, 0.3)) for branch in BRANCHES]
    for q in found:
        if q is not None:
            assert end_effector(arm, q) == pytest.approx(point, abs=1e-9)
            assert q[3:] == pytest.approx([roll, bend, 0.3])
    assert bend != 0.0 or all(q is not None for q in found)


def test_reach_is_attained_and_never_passed():
    arm = placed("master")
    q = np.array([0.0, 0.4, np.arctan2(0.07, 0.302) - np.pi / 2, 0.0, 0.0, 0.0])
    q[4] = -np.arctan2(0.07, 0.302)
    away = np.linalg.norm(end_effector(arm, q) - shoulder(arm.placement.translation))
    assert away == pytest.approx(reach(), abs=1e-12)
    rows = arm.arm.random_configurations(2000, np.random.default_rng(1))
    far = np.linalg.norm(end_effector(arm, rows) - shoulder(arm.placement.translation), axis=1)
    assert far.max() <= reach() + 1e-12
    assert branch_posture(arm, PRINTED.master_goal, "front_shallow") is None


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


def test_variants_and_reconstruction():
    reading = Improved.nominal()
    names = [variant.name for variant in VARIANTS]
    assert sorted(names) == sorted({"traditional", "V", "A", "B", "VA", "VB", "AB", "VAB"})
    for variant in VARIANTS:
        chosen = reading.settings(variant)
        assert chosen.two_sided == ("B" in variant.name)
        assert (chosen.variable_gain.rule == "constant") == ("V" not in variant.name)
        assert (chosen.step.rule == "constant") == ("A" not in variant.name)
    changed = reading.reconstructed()
    assert 1e-4 < changed.gain_ratio == balance_ratio() < 1e-3
    assert changed.settings().radii == pytest.approx(Links.nominal().link_radii[2:])
    assert replace(reading, gain_ratio=1e-3).plan().searches != reading.plan().searches


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


def test_pulled_back_point_is_on_the_ray():
    base = np.array([0.35, 0.0, 0.0])
    point = pulled_back(PRINTED.master_goal, base, 0.63) - shoulder(base)
    assert np.linalg.norm(point) == pytest.approx(0.63)
    assert np.cross(point, PRINTED.master_goal - shoulder(base)) == pytest.approx(
        np.zeros(3), abs=1e-12
    )
