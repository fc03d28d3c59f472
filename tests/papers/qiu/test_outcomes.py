"""Outcomes of the runs of `qiu`: campaigns, execution of both arms, hull, stored studies."""

import numpy as np
import pytest

from dualarm_repro.ledger import REGISTRY
from dualarm_repro.papers.qiu import improvements, studies
from dualarm_repro.papers.qiu.campaign import campaign, rate
from dualarm_repro.papers.qiu.execution import both_arms, dual_scene, executed
from dualarm_repro.papers.qiu.goals import draw_goals
from dualarm_repro.papers.qiu.hull_model import protrusions
from dualarm_repro.papers.qiu.random_tasks import random_task
from dualarm_repro.papers.qiu.readings import (
    IMPROVED_VARIANT,
    SLAVE,
    TRADITIONAL_VARIANT,
    dual_plan,
    link_radii,
    reconstructed,
    traditional_plan,
)
from dualarm_repro.papers.qiu.scenario import ZETA, placed
from dualarm_repro.planning.checks.contact_check import contact_check
from dualarm_repro.planning.search.bidirectional import repulsive_torque, surroundings_at
from dualarm_repro.planning.search.failure import Failure, classify
from dualarm_repro.scene import JointPath


@pytest.fixture(scope="module")
def values():
    return REGISTRY.nominal("qiu")


def test_improved_is_at_least_as_good_as_traditional(values):
    goals = draw_goals(values, 7)
    for ratio in (1e-4, 1e-2, 1.0):
        changed = values | {"gain_ratio": ratio}
        one, two = (campaign(changed, v, goals) for v in (TRADITIONAL_VARIANT, IMPROVED_VARIANT))
        assert sum(two.planner) >= sum(one.planner)
        for made in (one, two):
            assert all(p or not t for p, t in zip(made.planner, made.truth, strict=True))
            assert len(made.searches) == sum(made.planner)
            assert sum(made.failures.values()) == len(made.planner) - sum(made.planner)


def test_rate_has_an_interval():
    found = rate([True] * 9 + [False])
    assert found["successes"] == 9
    assert found["of"] == 10
    assert found["low"] < found["rate"] < found["high"]


def test_goal_is_displaced_by_the_ratio_in_proportion(values):
    """Close to a goal that obstacles repel, attraction zeta e balances the repulsion there."""
    plan = traditional_plan(values | {"gain_ratio": 1e-3, "joint_tolerance": 1e-3})
    assert classify(plan) is Failure.DISPLACED_GOAL
    made = plan.problem
    found = surroundings_at(made, 0, made.goal, 0)
    torque = repulsive_torque(made, found, np.full(3, 1e-3 * ZETA))
    rest = plan.path[-30:].mean(axis=0)
    assert np.linalg.norm(rest - made.goal) == pytest.approx(
        np.linalg.norm(torque) / ZETA, rel=0.35
    )


def test_replay_reproduces_the_reported_clearance(values):
    plan = dual_plan(reconstructed(values, SLAVE))
    reported = executed(plan)
    master, slave = both_arms(plan)
    moving = dual_scene().replaying("master", JointPath(master))
    replayed = contact_check(moving, slave, max_step=0.005)
    assert replayed.clearance["arms"] == pytest.approx(reported.clearance["arms"], abs=1e-3)
    other = executed(plan, "uniform")
    assert abs(other.clearance["arms"] - reported.clearance["arms"]) > 1e-3


def test_thinner_links_leave_more_room(values):
    plan = dual_plan(reconstructed(values, SLAVE))
    thin = link_radii(values | {"link_radius_scale": 0.8})
    assert executed(plan, radii=thin).smallest > executed(plan).smallest


def test_protrusion_is_zero_for_circles_as_thick_as_a_wall(values):
    arm = placed("master")
    q = arm.arm.random_configurations(5, np.random.default_rng(2))
    wide = values | {"hull_radii": [0.5] * 6}
    assert protrusions(arm, q, wide).max() < protrusions(arm, q, values).max()


@pytest.mark.parametrize(
    "study",
    [studies.ABLATION, studies.FIT, studies.SCENES, studies.PAIRS, improvements.IMPROVEMENTS],
    ids=lambda study: study.name,
)
def test_stored_study_is_what_the_code_gives(study):
    assert len(study.load()) == len(study.cells())
    assert study.spot_check(1, seed=11) == []


def test_random_tasks_are_blocked_and_their_ends_are_clear():
    rng = np.random.default_rng(4)
    scene, start, goal = random_task(3, rng)
    assert contact_check(scene, np.array([start, goal])).smallest < 0.0
    for q in (start, goal):
        assert contact_check(scene, np.array([q, q])).free
    assert len(scene.obstacles) == 3
