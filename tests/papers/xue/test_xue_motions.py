"""Both motions: readable and compiled planner, time index, distances, whole links."""

from dataclasses import replace

import coal
import numpy as np
import pytest

from dualarm_repro.papers.xue.document import gains, master_goal, placed_slave
from dualarm_repro.papers.xue.motions import (
    cores_of,
    largest_radius,
    master_plan,
    master_track,
    master_undisturbed,
    points_to_window,
    replay_of,
    slave_obstacles,
    slave_plan,
    slave_undisturbed,
    smallest_cores,
)
from dualarm_repro.papers.xue.reading import improved, nominal, traditional
from dualarm_repro.planning import plan_apf


@pytest.fixture(scope="module")
def case(registry):
    return nominal()


def test_printed_gains_reach_the_planner(case):
    settings = improved(case.planner, case.layout.window_centre, master_goal())
    assert gains() == {
        "k_a": settings.attraction.gain,
        "k_w": settings.virtual_point.gain,
        "k_r": settings.repulsion.gain,
        "d_0": settings.repulsion.influence,
    }
    assert traditional(case.planner, "end_effector").attraction.joint_weight == 0.0


def test_readable_and_compiled_plans_agree(case):
    placed, plan = placed_slave(case.layout), slave_plan(case)
    settings = improved(case.planner, case.layout.window_centre, placed.goal)
    readable = plan_apf(placed, placed.start, placed.goal, slave_obstacles(case), settings)
    assert readable.reason is plan.reason
    np.testing.assert_allclose(readable.path, plan.path, atol=1e-12)


def test_master_ends_at_the_printed_goal(case):
    plan = master_plan(case.layout, case.planner)
    assert np.abs(plan.path[-1] - master_goal()).max() <= case.planner.goal_tolerance


def test_slave_meets_the_planned_master_step_by_step(case):
    obstacles, plan = slave_obstacles(case), master_plan(case.layout, case.planner)
    flange = [name for name in obstacles.names if name.startswith("master")].index("master/frame_6")
    np.testing.assert_allclose(obstacles.cores[:, flange, 0], plan.tcp, atol=1e-12)


def test_equal_tool_speed_retimes_the_master(case):
    other = case._replace(encounter=replace(case.encounter, equal_speed_meaning="same_tool_speed"))
    track, slave = master_track(other), slave_undisturbed(case.layout, case.planner)
    plan = master_plan(case.layout, case.planner)
    assert track.index[-1] == pytest.approx(plan.tcp_length * slave.steps / slave.tcp_length)
    assert not np.allclose(np.diff(track.index), 1.0)


def test_undisturbed_plans_ignore_everything(case):
    moved = replace(case.layout, window_centre_x=0.05)
    first = slave_undisturbed(case.layout, case.planner)
    np.testing.assert_array_equal(first.path, slave_undisturbed(moved, case.planner).path)
    assert first.reached
    assert master_undisturbed(case.layout, case.planner).reached


def test_distance_to_the_window_is_that_of_coal(case):
    plan = slave_undisturbed(case.layout, case.planner)
    found = points_to_window(plan, case.layout)
    for row in (0, int(found.argmin()), plan.steps):
        point = coal.Sphere(1e-9), coal.Transform3s(np.eye(3), plan.tcp[row])
        results = []
        for box in case.layout.window():
            result = coal.DistanceResult()
            coal.distance(*point, *box.coal(), coal.DistanceRequest(), result)
            results.append(result.min_distance)
        assert found[row] == pytest.approx(min(results), abs=1e-6)


def test_flange_is_among_the_control_points(case):
    plan = master_plan(case.layout, case.planner)
    points = points_to_window(plan, case.layout, "frames_2_6")
    assert (points >= points_to_window(plan, case.layout, "capsules") - 1e-12).all()


def test_cores_of_links_and_the_radius_they_allow(case):
    cores = cores_of(replay_of(case, slave_plan(case)), case.layout)
    smallest = smallest_cores(cores)
    found = (smallest["slave_window"], smallest["master_window"], 0.5 * smallest["arms"])
    assert largest_radius(smallest) == min(found) > 0.0
    # A point of a core cannot be farther from the bars than the whole core.
    points = points_to_window(slave_plan(case), case.layout, "frames_2_6")
    assert smallest["slave_window"] <= points.min() + 1e-9


def test_limits_enforced_refuse_the_printed_start(case):
    planner = replace(case.planner, joint_limits_in_motion="enforced")
    assert master_plan(case.layout, planner) is None
