"""Two motions replayed, their speeds, turns to a virtual point, and what many runs come to."""

from types import SimpleNamespace

import numpy as np
import pytest
from window_scene import (
    GOAL,
    IMPROVED,
    MASTER,
    MASTER_GOAL,
    MASTER_START,
    SLAVE,
    START,
    TRADITIONAL,
    around,
)

from dualarm_repro.planning import perturbed, plan_apf_compiled
from dualarm_repro.planning.checks.field_agreement import gradient_error
from dualarm_repro.planning.descent.problem import problem
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.planning.field.potentials import JointAttraction
from dualarm_repro.planning.trials.free_minima import descend, free_minima
from dualarm_repro.planning.trials.outcome import outcome
from dualarm_repro.planning.trials.replay import Replay
from dualarm_repro.planning.trials.runs import attempt, run_trials
from dualarm_repro.planning.trials.speeds import mean_advance
from dualarm_repro.planning.trials.turns import onsets, phases, stands_still
from dualarm_repro.scene import JointPath, PlacedArm, Sphere

ARM = PlacedArm("slave", SLAVE.arm, SLAVE.placement, START, GOAL)
PLAN = plan_apf_compiled(ARM, START, GOAL, around(), IMPROVED)
TRACK = JointPath(np.linspace(MASTER_START, MASTER_GOAL, PLAN.steps + 31))
REPLAY = Replay(PLAN, MASTER, TRACK, around())


def test_a_replay_lasts_until_both_rest():
    frame = REPLAY.to_frame()
    assert len(frame) == len(REPLAY.times) == len(REPLAY.apart()) == PLAN.steps + 31
    slave = frame[[f"slave_{axis}_m" for axis in "xyz"]].to_numpy()
    np.testing.assert_array_equal(slave[-1], PLAN.tcp[-1])
    master = frame[[f"master_{axis}_m" for axis in "xyz"]].to_numpy()
    np.testing.assert_allclose(master[-1], end_effector(MASTER, MASTER_GOAL), atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(slave - master, axis=1), REPLAY.apart())
    assert REPLAY.configurations()["slave"].shape == (len(frame), 6)
    assert set(REPLAY.paths) == {"master", "slave"}
    assert len(REPLAY.to_obstacles()) == PLAN.steps + 1


def test_speeds_of_a_track_at_constant_pace():
    path = JointPath(np.linspace(np.zeros(6), np.full(6, 0.5), 6), 2.0 * np.arange(6))
    assert mean_advance(path.configurations, path.index) == pytest.approx(0.1 * np.sqrt(6) / 2.0)
    points = np.linspace([0.0, 0.0, 0.0], [3.0, 0.0, 0.0], 6)
    assert mean_advance(points, path.index) == pytest.approx(0.3)


def test_turns_are_the_changes_of_what_acts():
    active = np.array([False, False, True, True, False, True])
    plan = SimpleNamespace(active=active, path=np.zeros((6, 2)))
    assert phases(plan) == [False, True, False, True]
    assert onsets(plan) == [2, 5]


def test_standing_still_takes_two_blocks_alike():
    path = np.concatenate([np.linspace([0.0], [1.0], 5), np.ones((8, 1))])
    plan = SimpleNamespace(path=path)
    assert stands_still(plan, 12, 4, 1e-3)
    assert not stands_still(plan, 8, 4, 1e-3)
    assert not stands_still(plan, 6, 4, 10.0)


def test_an_attempt_from_a_start_in_contact_is_none():
    ball = around(ball=Sphere(SLAVE.placement.act(SLAVE.arm.positions(START)), 0.02))
    assert attempt(ARM, START, ball, IMPROVED) is None
    assert attempt(ARM, START, around(), IMPROVED).reason == PLAN.reason


def test_an_outcome_counts_its_runs():
    starts = perturbed(START, 0.1, 4, np.random.default_rng(0))
    made = problem(ARM, START, GOAL, around(), TRADITIONAL)
    runs = run_trials(ARM, starts, around(), TRADITIONAL)
    found = outcome(made, runs)
    assert found.runs == 4
    assert found.missed == int((~runs.reached).sum())
    assert found.held <= found.trapped
    assert found.steps_all == runs.steps.mean()
    assert outcome(made, runs, at_goal=np.inf).trapped == 0
    none = outcome(made, runs._replace(reason=np.full(4, "x", dtype=object)))
    assert none.missed == 4
    assert np.isnan(none.steps_reached)


def test_the_joint_term_alone_has_no_minimum_elsewhere():
    field = JointAttraction(GOAL, 3.0)
    np.testing.assert_allclose(descend(field, START), GOAL, atol=1e-8)
    assert gradient_error(field, START[np.newaxis]) < 1e-6
    ends = {"arrived": 0.02, "flat": 1e-7}
    assert free_minima(ARM, 3.0, 1e3, 5, np.random.default_rng(0), **ends) == (0, 0)
    few = free_minima(ARM, 3.0, 1e-2, 10, np.random.default_rng(0), **ends)
    assert few.elsewhere >= few.minima > 0
