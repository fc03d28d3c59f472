"""Batches: each run ends as the plan of its own start does."""

import numpy as np
import pytest
from window_scene import GOAL, IMPROVED, SLAVE, START, TRADITIONAL, around

from dualarm_repro.errors import ConfigurationError, InputError
from dualarm_repro.planning import (
    certify,
    perturbed,
    plan_apf_compiled,
    plan_batch,
    plan_cartesian_ik_batch,
)
from dualarm_repro.planning.descent.problem import problem
from dualarm_repro.scene import Sphere

STARTS = perturbed(START, 0.1, 6, np.random.default_rng(0))
VARIANTS = {
    "improved": IMPROVED,
    "traditional": TRADITIONAL,
    "virtual point": TRADITIONAL.changed(virtual_point=IMPROVED.virtual_point),
}


@pytest.mark.parametrize("settings", VARIANTS.values(), ids=VARIANTS)
def test_each_run_is_the_plan_of_its_start(settings):
    batch = plan_batch(SLAVE, STARTS, GOAL, around(), settings)
    for k, start in enumerate(STARTS):
        plan = plan_apf_compiled(SLAVE, start, GOAL, around(), settings)
        assert (batch.reason[k], batch.steps[k]) == (plan.reason, plan.steps)
        assert np.array_equal(batch.last[k], plan.path[-1])
        assert batch.clearance[k] == plan.clearance.min()
        assert (batch.activations[k], batch.arrivals[k]) == (plan.activations, plan.arrivals)
        assert batch.rescued[k] == plan.rescued
        assert batch.reached[k] == plan.reached
        made = problem(SLAVE, start, GOAL, around(), settings)
        gradient = certify(made, plan.path[-1], plan.steps).gradient_norm
        assert batch.gradient_norm[k] == pytest.approx(gradient, rel=1e-6, abs=1e-9)


def test_near_the_goal_is_told_from_trapped():
    ball = around(
        ball=Sphere(SLAVE.placement.act(SLAVE.arm.positions(GOAL)) - np.array([0, 0, 0.3]), 0.1)
    )
    settings = IMPROVED.changed(virtual_point=None)
    batch = plan_batch(SLAVE, STARTS, GOAL, ball, settings)
    assert {str(reason) for reason in batch.reason} == {"goal-not-reachable-near-obstacle"}


def test_perturbed_starts_are_seeded_and_bounded():
    again = perturbed(START, 0.1, 6, np.random.default_rng(0))
    assert np.array_equal(again, STARTS)
    many = perturbed(START, 0.1, 500, np.random.default_rng(1)) - START
    assert np.abs(many).max() <= 0.1
    assert np.abs(many).max() > 0.09
    assert np.abs(many.mean(axis=0)).max() < 0.02


def test_one_bad_start_is_named():
    ball = around(ball=Sphere(SLAVE.placement.act(SLAVE.arm.positions(STARTS[4])), 0.02))
    with pytest.raises(InputError, match="frame_6 outside ball"):
        plan_batch(SLAVE, STARTS, GOAL, ball, IMPROVED)
    with pytest.raises(ConfigurationError):
        plan_batch(SLAVE, np.zeros((2, 5)), GOAL, around(), IMPROVED)


def test_without_a_start_there_is_no_batch():
    expected = r"shape of starts = \(0, 6\): expected at least one row of 6 finite numbers"
    for plan in (plan_batch, plan_cartesian_ik_batch):
        with pytest.raises(ConfigurationError, match=expected):
            plan(SLAVE, np.empty((0, 6)), GOAL, around(), IMPROVED)


@pytest.mark.parametrize(
    ("start", "line"),
    [
        (START[:, np.newaxis], r"start \(its shape\) = \(6, 1\): expected finite numbers \(n,\)"),
        (np.array([START]), r"start \(its shape\) = \(1, 6\)"),
        (0.3, r"start \(its shape\) = \(\)"),
        (np.where(np.arange(6) == 3, np.nan, START), "start = nan: expected finite numbers"),
        (["a"] * 6, "start = "),
    ],
)
def test_only_one_configuration_is_perturbed(start, line):
    with pytest.raises(InputError, match=f"perturbed: {line}"):
        perturbed(start, 0.1, 3, np.random.default_rng(0))


def test_a_width_of_minus_zero_is_none():
    drawn = perturbed(START.tolist(), -0.0, 3, np.random.default_rng(0))
    assert np.array_equal(drawn, np.tile(START, (3, 1)))
    assert perturbed(START, 0.1, 0, np.random.default_rng(0)).shape == (0, 6)
