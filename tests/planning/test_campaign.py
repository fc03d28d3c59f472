"""Campaigns of plans: what the planner says, what is true, how the others failed."""

from importlib.util import find_spec

import numpy as np
import pytest
from two_spheres import GOAL, ONE_SIDED, START, obstacles, placed_arm, settings, shapes

from dualarm_repro.planning.checks.recorded_steps import step_difference
from dualarm_repro.planning.search.bidirectional_compiled import plan_bidirectional_compiled
from dualarm_repro.planning.search.rrt_connect import SampledPlan
from dualarm_repro.planning.trials.campaign import campaign
from dualarm_repro.planning.trials.yardstick import yardstick
from dualarm_repro.scene import Scene

GOALS = (GOAL, GOAL + 0.1, START + 0.2)


def planned(goal, **changes):
    return plan_bidirectional_compiled(placed_arm(), START, goal, obstacles(), settings(**changes))


def scene():
    return Scene([placed_arm()], shapes())


@pytest.mark.parametrize("changes", [{}, ONE_SIDED, ONE_SIDED | {"ending": {"search_limit": 5}}])
def test_counts_of_a_campaign_agree(changes):
    made = campaign(lambda goal: planned(goal, **changes), GOALS, scene())
    assert len(made.planner) == len(made.truth) == len(made.clearance) == len(GOALS)
    assert all(p or not t for p, t in zip(made.planner, made.truth, strict=True))
    assert len(made.searches) == sum(made.planner)
    assert sum(made.failures.values()) == len(GOALS) - sum(made.planner)


def test_failures_are_classed():
    both = campaign(lambda goal: planned(goal, ending={"search_limit": 2}), GOALS, scene())
    assert both.failures == {"halves-apart": 3}
    one = campaign(
        lambda goal: planned(goal, **ONE_SIDED, ending={"search_limit": 2}), GOALS, scene()
    )
    assert one.failures == {"no-rest": 3}


@pytest.mark.parametrize("order", ["before", "after"])
@pytest.mark.parametrize("side", [0, 1])
def test_recorded_steps_follow_the_resultant_and_no_other_gain(order, side):
    plan = planned(GOAL, order=order)
    assert step_difference(plan, side) < 1e-9
    assert step_difference(plan, side, lambda factor, initial: 2.0 * factor * initial) > 1e-6
    assert step_difference(plan, side, lambda factor, initial: np.nan) == np.inf


@pytest.mark.skipif(find_spec("ompl") is None, reason="OMPL is not installed")
def test_the_yardstick_says_what_it_checked():
    found = yardstick(scene(), START, START + 0.05, np.random.default_rng(0), 2000)
    assert found.keys() == {"rrt_connect_planner", "rrt_connect_truth", "rrt_connect_checks"}
    assert found["rrt_connect_checks"] > 0


@pytest.mark.skipif(find_spec("ompl") is None, reason="OMPL is not installed")
def test_the_yardstick_has_the_seed_of_the_stream(monkeypatch):
    seeds = []

    def sampled(scene, start, goal, seed, most):
        seeds.append(seed)
        return SampledPlan(None, 0)

    monkeypatch.setattr("dualarm_repro.planning.trials.yardstick.plan_rrt_connect", sampled)
    yardstick(scene(), START, GOAL, np.random.default_rng(0), 10)
    assert seeds == [int(np.random.default_rng(0).integers(2**31 - 2))]


def test_without_the_package_there_is_no_yardstick(monkeypatch):
    monkeypatch.setattr("dualarm_repro.planning.trials.yardstick.find_spec", lambda name: None)
    assert yardstick(scene(), START, GOAL, np.random.default_rng(0), 10) == {}
