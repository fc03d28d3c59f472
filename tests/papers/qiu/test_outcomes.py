"""Outcomes of the runs of `qiu`: campaigns, execution of both arms, hull, stored studies."""

from dataclasses import replace

import numpy as np
import pytest

from dualarm_repro.ledger.spot import spot_check
from dualarm_repro.papers import load
from dualarm_repro.papers.qiu.document import PRINTED, dual_scene, placed, truth_scene
from dualarm_repro.papers.qiu.reading import (
    GoalBox,
    Hull,
    Improved,
    Links,
    Slave,
    Traditional,
)
from dualarm_repro.papers.qiu.studies.improvements import RATIOS, nearest
from dualarm_repro.planning.checks.contact_check import contact_check
from dualarm_repro.planning.checks.hull_cover import protrusions
from dualarm_repro.planning.search.bidirectional import repulsive_torque, surroundings_at
from dualarm_repro.planning.search.failure import Failure, classify
from dualarm_repro.planning.search.variants import TRADITIONAL
from dualarm_repro.planning.trials.campaign import campaign
from dualarm_repro.scene import JointPath

STUDIES = [study for name, study in load().studies.items() if name.startswith("qiu_")]


def test_improved_is_at_least_as_good_as_traditional():
    goals = GoalBox.nominal().draw(7).q
    for ratio in (1e-4, 1e-2, 1.0):
        reading = Improved.nominal(gain_ratio=ratio)
        scene = truth_scene([reading.arm()])
        two, one = (
            campaign(lambda q, v=v, r=reading: r.plan_to(q, v), goals, scene)
            for v in (None, TRADITIONAL)
        )
        assert sum(two.planner) >= sum(one.planner)


def test_a_displaced_goal_is_where_attraction_balances_repulsion():
    """At rest beside a goal that obstacles repel, zeta e is the torque of the repulsion there.

    Steps of a fixed length end in a chatter about that point, by half of which it is known.
    """
    plan = Traditional.nominal(gain_ratio=1e-3, joint_tolerance=1e-3).plan()
    assert classify(plan) is Failure.DISPLACED_GOAL
    made = plan.problem
    last = plan.path[-30:]
    rest, chatter = last.mean(axis=0), np.linalg.norm(np.ptp(last, axis=0))
    found = surroundings_at(made, 0, rest, 0)
    torque = repulsive_torque(made, found, np.full(3, 1e-3 * PRINTED.zeta))
    displaced, balance = rest - made.goal, torque / PRINTED.zeta
    assert np.linalg.norm(displaced - balance) < 0.5 * chatter < 0.5 * np.linalg.norm(displaced)


def test_replay_reproduces_the_reported_clearance():
    reading = Slave.nominal(gain_ratio=1e-3)
    plan, scene = reading.dual_plan(), reading.scene()
    reported = plan.contact(scene)
    master, slave = plan.played()
    moving = dual_scene().replaying("master", JointPath(master))
    replayed = contact_check(moving, slave, max_step=0.005)
    assert replayed.clearance["arms"] == pytest.approx(reported.clearance["arms"], abs=1e-3)
    other = plan.contact(scene, "uniform")
    assert abs(other.clearance["arms"] - reported.clearance["arms"]) > 1e-3


def test_thinner_links_leave_more_room():
    reading = Slave.nominal(gain_ratio=1e-3)
    plan, thin = reading.dual_plan(), Links.nominal(link_radius_scale=0.8).radii
    assert plan.contact(reading.scene(thin)).smallest > plan.contact(reading.scene()).smallest


def test_protrusion_is_zero_for_circles_as_thick_as_a_wall():
    arm, hull = placed("master"), Hull.nominal()
    q = arm.arm.random_configurations(5, np.random.default_rng(2))
    wide = replace(hull, hull_radii=(0.5,) * 6)
    assert protrusions(arm, q, wide.circles()).max() < protrusions(arm, q, hull.circles()).max()


@pytest.mark.parametrize("study", STUDIES, ids=lambda study: study.name)
def test_stored_study_is_what_the_code_gives(study):
    assert len(study.load()) == len(study.cells())
    assert spot_check(study, 1, seed=11).wrong == []


def test_all_studies_are_registered():
    assert len(STUDIES) == 10


def test_the_stored_ratio_is_the_nearest_by_its_factor():
    assert nearest(0.04) == 0.1
    assert nearest(0.02) == 0.01
    assert all(nearest(ratio) == ratio for ratio in RATIOS)
