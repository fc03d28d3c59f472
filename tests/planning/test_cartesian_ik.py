"""The field in Cartesian space: the flange moves as a point, the arm follows by its inverse."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from window_scene import FIXED, GOAL, SEARCH, SLAVE, START, TRADITIONAL, around

from dualarm_repro.arms import load_arm
from dualarm_repro.differences import central_differences
from dualarm_repro.errors import InputError, UnsupportedArmError
from dualarm_repro.planning import FollowReason, StopReason, obstacles_of
from dualarm_repro.planning.descent import cartesian_ik, cartesian_kernels
from dualarm_repro.planning.descent.cartesian_ik import plan_cartesian_ik, plan_cartesian_ik_batch
from dualarm_repro.planning.field.control_points import end_effector
from dualarm_repro.planning.field.field_kernels import workspace
from dualarm_repro.scene import PlacedArm, Scene, Sphere

NOTHING = obstacles_of(Scene([SLAVE]))
LOOKED_AT = TRADITIONAL.changed(control_points="frames_2_6")
GOAL_POINT = end_effector(SLAVE, GOAL)


def test_without_obstacles_the_flange_runs_straight_and_the_tool_ends_as_at_the_goal():
    plan = plan_cartesian_ik(SLAVE, START, GOAL, NOTHING, LOOKED_AT)
    assert plan.reached
    chord = (GOAL_POINT - plan.tcp[0]) / np.linalg.norm(GOAL_POINT - plan.tcp[0])
    off = plan.tcp - plan.tcp[0]
    assert np.linalg.norm(off - np.outer(off @ chord, chord), axis=1).max() < 1e-9
    ends = [SLAVE.arm.fk(q)[:3, :3] for q in (plan.path[-1], GOAL)]
    assert Rotation.from_matrix(ends[0].T @ ends[1]).magnitude() < 0.05
    assert np.abs(plan.path[-1] - GOAL)[:3].max() < 0.1


@pytest.mark.parametrize("update", [TRADITIONAL.update, FIXED, SEARCH])
def test_a_step_is_bounded_and_the_arm_follows_without_a_jump(update):
    plan = plan_cartesian_ik(SLAVE, START, GOAL, around(), LOOKED_AT.changed(update=update))
    lever = np.linalg.norm(plan.tcp[:-1] - SLAVE.placement.translation, axis=1)
    steps = np.linalg.norm(np.diff(plan.tcp, axis=0), axis=1)
    assert (steps <= update.max_step * lever + 1e-9).all()
    assert np.abs(np.diff(plan.path, axis=0)).max() <= cartesian_kernels.JUMP


def test_the_slope_is_the_derivative_of_the_potential():
    made, checked = cartesian_ik._problems(SLAVE, START, GOAL, around(), LOOKED_AT)
    field = cartesian_ik._follower(made, checked).point
    work = workspace(field)
    work.frames[:] = field.base
    for X in np.array([[0.35, 0.7, 0.3], [0.3, 0.82, 0.2], [0.0, 0.5, 0.6]]):
        found = central_differences(
            lambda at: np.array([cartesian_kernels.potential(field, tuple(at), 0, work)]), X, 1e-6
        )
        cartesian_kernels.potential(field, tuple(X), 0, work)
        slope = cartesian_kernels.slope_at(field, tuple(X), 0, work)
        np.testing.assert_allclose(slope, np.ravel(found), rtol=1e-5, atol=1e-6)


def test_a_batch_ends_as_its_single_plans_do():
    starts = START + np.random.default_rng(0).uniform(-0.1, 0.1, (4, 6))
    batch = plan_cartesian_ik_batch(SLAVE, starts, GOAL, around(), LOOKED_AT)
    for k, start in enumerate(starts):
        plan = plan_cartesian_ik(SLAVE, start, GOAL, around(), LOOKED_AT)
        assert (plan.reason, plan.steps) == (batch.reason[k], batch.steps[k])
        np.testing.assert_array_equal(plan.path[-1], batch.last[k])
        assert batch.clearance[k] == plan.clearance.min()


def test_a_ball_in_the_way_is_a_trap():
    """On the line between start and goal nothing pushes the point aside."""
    middle = 0.5 * (end_effector(SLAVE, START) + GOAL_POINT)
    ball = obstacles_of(Scene([SLAVE], {"ball": Sphere(middle, 0.1)}))
    plan = plan_cartesian_ik(SLAVE, START, GOAL, ball, TRADITIONAL)
    assert plan.reason is StopReason.TRAPPED
    assert plan.clearance.min() > 0.0


def test_an_elbow_that_meets_a_ball_ends_the_motion():
    """The flange is out of its range, so that only the look at every step sees it."""
    free = plan_cartesian_ik(SLAVE, START, GOAL, NOTHING, LOOKED_AT)
    half = free.path[free.steps // 2]
    wrist = SLAVE.arm.joint_positions(half)[2] + SLAVE.placement.translation
    ball = obstacles_of(Scene([SLAVE], {"ball": Sphere(wrist, 0.02)}))
    assert plan_cartesian_ik(SLAVE, START, GOAL, ball, LOOKED_AT).reason is FollowReason.COLLIDES
    assert plan_cartesian_ik(SLAVE, START, GOAL, ball, TRADITIONAL).reached


def test_beside_a_singular_wrist_no_posture_continues_the_motion():
    """The tool turns past axis 4, and the wrist would have to spin within one step."""
    here, there = (
        np.array([0.0, -0.5, 0.3, 0.0, 0.4, 0.0]),
        np.array([0.3, -0.5, 0.3, 0.03, -0.4, 0.0]),
    )
    plan = plan_cartesian_ik(SLAVE, here, there, NOTHING, LOOKED_AT)
    assert plan.reason is FollowReason.NO_POSTURE


def test_what_cannot_be_planned_is_refused():
    panda = PlacedArm("panda", load_arm("panda"))
    q = np.zeros(panda.arm.nq) + 0.1
    with pytest.raises(UnsupportedArmError):
        plan_cartesian_ik(panda, q, q, obstacles_of(Scene([panda])), TRADITIONAL)
    touching = obstacles_of(Scene([SLAVE], {"ball": Sphere(end_effector(SLAVE, START), 0.1)}))
    with pytest.raises(InputError):
        plan_cartesian_ik(SLAVE, START, GOAL, touching, LOOKED_AT)
