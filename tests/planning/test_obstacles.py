"""Obstacles: the arrays hold the shapes of the scene at every step."""

import numpy as np
import pinocchio as pin
import pytest
from window_scene import GOAL, MASTER, SLAVE, START, around, scene, window

from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.planning import control_points, obstacles_of
from dualarm_repro.planning.field.control_points import ends_of
from dualarm_repro.scene import (
    Box,
    ConvexHull,
    JointPath,
    MovingArm,
    MovingShape,
    PosePath,
    Scene,
    Sphere,
    point_distances,
)

SHIFT = PosePath([pin.SE3.Identity(), pin.SE3(np.eye(3), np.array([0.0, 0.0, 2.0]))], [0, 4])


def points_at(x):
    return np.broadcast_to(np.array(x)[None, None, None], (1, 1, 2, 3))


def test_bars_form_one_obstacle_and_the_floor_another():
    obstacles = obstacles_of(Scene([MASTER], {"window": window()}, floor=-1.0))
    assert obstacles.names == ("window/0", "window/1", "window/2", "window/3", "floor")
    assert obstacles.group.tolist() == [0, 0, 0, 0, 1]
    assert not obstacles.moving(0)


def test_distances_are_those_of_the_shapes():
    shapes = {"ball": Sphere((1, 0, 0), 0.2), "crate": Box((0, 1, 0), (0.4, 0.2, 0.6))}
    obstacles = obstacles_of(Scene([MASTER], shapes, floor=-0.5))
    rng = np.random.default_rng(0)
    for x in rng.uniform(-1.5, 1.5, (30, 3)):
        distance, _, outward = obstacles.distances(points_at(x), np.array([0.05]), 0)
        expected, gradient = point_distances(x, list(shapes.values()))
        assert distance[0, 0, :2] == pytest.approx(expected - 0.05)
        assert outward[0, 0, :2] == pytest.approx(gradient)
        assert distance[0, 0, 2] == pytest.approx(x[2] + 0.5 - 0.05)


def test_a_moving_shape_is_met_at_the_step_and_then_rests():
    obstacles = obstacles_of(
        Scene([MASTER], {}, {"ball": MovingShape(Sphere((0, 0, 0), 0.1), SHIFT)})
    )
    for step, height in ((0, 0.0), (1, 0.5), (4, 2.0), (900, 2.0)):
        distance = obstacles.distances(points_at((0, 0, 3.0)), np.zeros(1), step)[0]
        assert distance.item() == pytest.approx(3.0 - height - 0.1)
    assert [obstacles.moving(step) for step in (0, 3, 4)] == [True, True, False]


def test_a_moving_arm_repels_by_its_points_or_by_its_capsules():
    path = JointPath(np.linspace(START, GOAL, 6))
    replayed = scene().replaying("slave", path)
    points = control_points(SLAVE.arm, "frames_2_6", radius=0.02)
    obstacles = obstacles_of(scene()).with_arm(SLAVE, points, path)
    assert obstacles.names[:2] == ("slave/frame_2", "slave/frame_3")
    assert len(set(obstacles.group[:5])) == 5
    for step in (0, 3, 50):
        expected = ends_of(SLAVE, points, path.at(np.array([float(step)])))[0]
        assert np.abs(obstacles.cores[obstacles.at(step), :5] - expected).max() < 1e-12
    whole = obstacles_of(replayed)
    assert whole.names[0] == "slave/capsule_0_joint_1"
    assert len(set(whole.group[: len(whole.radius)])) == 1


def test_an_arm_can_be_added_to_obstacles():
    path = JointPath(np.linspace(START, GOAL, 6), 2.0 * np.arange(6))
    points = control_points(SLAVE.arm, "end_effector")
    added = around().with_arm(SLAVE, points, path)
    found, names = len(around().radius), around().names
    assert added.names == (*names[:found], "slave/flange", *names[found:])
    for step in (0, 5, 10):
        expected = ends_of(SLAVE, points, path.at(np.array([float(step)])))[0]
        assert np.array_equal(added.cores[step, found:], expected)
    assert len(added.cores) == len(added.boxes) == 11
    assert added.group[found] == 1 + around().group.max()


def test_nothing_is_an_obstacle_too():
    nothing = obstacles_of(Scene([MASTER]))
    distance, *_ = nothing.distances(np.zeros((3, 2, 2, 3)), np.zeros(2), 5)
    assert distance.shape == (3, 2, 0)


def test_what_a_planner_is_not_told():
    there = Scene([MASTER], {"window": window()}, floor=-1.0)
    assert (
        obstacles_of(there, leave_out=["floor"]).names
        == obstacles_of(Scene([MASTER], {"window": window()})).names
    )


@pytest.mark.parametrize(
    ("call", "error", "expected"),
    [
        (lambda: obstacles_of(scene(), ["door"]), UnknownNameError, "one of window"),
        (
            lambda: around(hull=ConvexHull(np.vstack([np.zeros(3), np.eye(3)]))),
            InputError,
            "spheres, capsules",
        ),
        (lambda: Sphere((0, 0, 0), 0.0), InputError, "positive"),
        (lambda: Box((0, 0, 0), (0.1, 0.0, 0.1)), InputError, r"size\[1\]"),
    ],
)
def test_bad_obstacles(call, error, expected):
    with pytest.raises(error, match=expected):
        call()


def test_moving_arm_keeps_its_type():
    moving = {"slave": MovingArm(SLAVE.arm, JointPath([START]), SLAVE.placement)}
    assert obstacles_of(Scene([MASTER], {}, moving)).moving(0) is False


@pytest.mark.parametrize(("count", "points"), [(0, 2), (2, 0), (0, 0)])
def test_no_configurations_or_points_have_no_distances(count, points):
    obstacles = obstacles_of(Scene([MASTER], {"ball": Sphere((1, 0, 0), 0.2)}, floor=-0.5))
    found = obstacles.distances(np.empty((count, points, 2, 3)), np.empty(points), 0)
    assert [part.shape for part in found] == [
        (count, points, 2),
        (count, points, 2, 3),
        (count, points, 2, 3),
    ]
