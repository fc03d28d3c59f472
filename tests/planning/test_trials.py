"""Campaigns of runs: ends, touching starts, what holds a run that stands still."""

import numpy as np
import pytest
from scipy.optimize import least_squares
from window_scene import GOAL, IMPROVED, SLAVE, START, TRADITIONAL, around

from dualarm_repro.differences import central_differences
from dualarm_repro.errors import InputError
from dualarm_repro.planning import certify, perturbed, plan_apf_compiled
from dualarm_repro.planning.descent.problem import problem
from dualarm_repro.planning.trials.held import FLAT, held, smallest_one_sided_curvature
from dualarm_repro.planning.trials.runs import TOUCHES, Runs, run_trials, touching
from dualarm_repro.planning.trials.stuck import STATIONARY, stationary
from dualarm_repro.scene import PlacedArm, Sphere, facing, window_frame

ARM = PlacedArm("slave", SLAVE.arm, SLAVE.placement, START, GOAL)
STARTS = perturbed(START, 0.1, 6, np.random.default_rng(0))
TIPS = [SLAVE.placement.act(SLAVE.arm.positions(q)) for q in (START, GOAL)]
#: Across the way, without an opening, and too wide to slide off.
ACROSS = facing((*(TIPS[1] - TIPS[0])[:2], 0.0))
WALL = around(wall=window_frame(np.mean(TIPS, axis=0), ACROSS, 0.02, 0.02, 0.3, 0.1))


def made(obstacles, settings):
    return problem(ARM, START, GOAL, obstacles, settings)


@pytest.mark.parametrize("settings", [IMPROVED, TRADITIONAL])
def test_each_run_ends_as_its_plan(settings):
    runs = run_trials(ARM, STARTS, around(), settings)
    for k, start in enumerate(STARTS):
        plan = plan_apf_compiled(ARM, start, GOAL, around(), settings)
        assert (runs.reason[k], runs.steps[k]) == (plan.reason, plan.steps)
        assert np.array_equal(runs.last[k], plan.path[-1])
        assert (runs.used[k], runs.rescued[k]) == (plan.activations > 0, plan.rescued)
        assert runs.reached[k] == plan.reached


def test_a_start_that_touches_is_a_run_of_its_own():
    ball = around(ball=Sphere(SLAVE.placement.act(SLAVE.arm.positions(STARTS[4])), 0.02))
    runs = run_trials(ARM, STARTS, ball, IMPROVED)
    found = touching(made(ball, IMPROVED), STARTS)
    assert found.tolist() == [False] * 4 + [True, False]
    assert runs.reason[found].tolist() == [TOUCHES]
    assert not runs.reached[4]
    assert not runs.stuck[4]
    assert np.array_equal(runs.last[4], STARTS[4])
    assert (runs.steps[~found] > 0).all()
    every = around(ball=Sphere(SLAVE.placement.act(SLAVE.arm.positions(STARTS[4])), 0.002))
    assert run_trials(ARM, STARTS[4:5], every, IMPROVED).reason.tolist() == [TOUCHES]


def test_a_touching_unperturbed_start_is_an_error():
    ball = around(ball=Sphere(SLAVE.placement.act(SLAVE.arm.positions(START)), 0.02))
    with pytest.raises(InputError, match="outside ball"):
        run_trials(ARM, STARTS, ball, IMPROVED)


def test_some_runs_replaced_leave_the_others_and_the_original():
    runs = run_trials(ARM, STARTS[:3], around(), IMPROVED)
    where = np.array([False, True, False])
    other = Runs(*(part[:1].copy() for part in runs))
    changed = runs.replaced(where, other)
    assert np.array_equal(changed.last[1], runs.last[0])
    assert np.array_equal(changed.last[[0, 2]], runs.last[[0, 2]])
    assert not np.array_equal(runs.last[1], runs.last[0])


def test_stationary_runs_stand_where_the_gradient_vanishes():
    runs = run_trials(ARM, STARTS, WALL, TRADITIONAL)
    wall = made(WALL, TRADITIONAL)
    found = stationary(wall, runs.last, runs.gradient)
    certain = found & (runs.gradient <= STATIONARY)
    assert certain.any()
    for q in runs.last[certain]:
        slopes = central_differences(wall.field.value, q, 1e-5)
        assert np.linalg.norm(slopes) <= 2.0 * STATIONARY


def test_what_moves_on_or_has_arrived_is_not_stationary():
    free = made(around(), TRADITIONAL)
    gradient = np.linalg.norm(free.field.gradient(START))
    assert gradient > STATIONARY
    assert not stationary(free, START[np.newaxis], np.array([gradient])).any()
    beside = GOAL + 0.02  # whose nearest stationary point is the goal
    assert not stationary(free, beside[np.newaxis], np.array([1.0])).any()


def test_a_wall_holds_an_arm_against_pushes():
    runs = run_trials(ARM, STARTS, WALL, TRADITIONAL)
    assert runs.stuck.all()
    wall = made(WALL, TRADITIONAL)
    assert held(wall, runs.last, stationary(wall, runs.last, runs.gradient)).all()
    pushed = runs.last + np.random.default_rng(0).uniform(-1e-3, 1e-3, runs.last.shape)
    assert not run_trials(ARM, pushed, WALL, TRADITIONAL).reached.any()


def test_a_saddle_does_not_hold():
    """Stretched out exactly away from its target an arm is in balance; any push frees it."""
    far = around(ball=Sphere(SLAVE.placement.translation + np.array([0.0, 0.0, 50.0]), 0.1))
    free, begin = made(far, TRADITIONAL), START + np.array([np.pi, 0.0, 0.0, 0.0, 0.0, 0.0])
    saddle = least_squares(free.field.gradient, begin, xtol=1e-14, ftol=1e-14, gtol=1e-14).x
    certified = certify(free, saddle, 0)
    assert certified.gradient_norm <= STATIONARY
    assert certified.smallest_curvature < -1.0
    assert certified.position_error > 0.5
    rows = saddle[np.newaxis]
    assert stationary(free, rows, np.array([certified.gradient_norm])).all()
    assert not held(free, rows, np.array([True])).any()


def test_what_one_side_of_an_edge_does_not_hold_is_not_held():
    """Past the edge of a face the repulsion turns aside: there the potential falls, on the face it
    rises, and the mean of both may be of either sign."""
    runs = run_trials(ARM, STARTS, WALL, TRADITIONAL)
    wall, q = made(WALL, TRADITIONAL), runs.last[0]

    class Edge:
        """The field with a slope that begins at q and only on one side of it."""

        def value(self, at, step=0):
            return wall.field.value(at, step) - 50.0 * np.maximum(at[..., 0] - q[0], 0.0) ** 2

        def gradient(self, at, step=0):
            extra = np.zeros(6)
            extra[0] = -100.0 * max(at[0] - q[0], 0.0)
            return wall.field.gradient(at, step) + extra

    class Edged:
        field, obstacles = Edge(), wall.obstacles

    assert smallest_one_sided_curvature(wall, q, 0) >= -FLAT
    assert smallest_one_sided_curvature(Edged(), q, 0) < -FLAT


def test_nothing_stuck_is_nothing_held():
    nothing = np.zeros(0, dtype=bool)
    assert held(made(WALL, TRADITIONAL), np.empty((0, 6)), nothing).shape == (0,)
