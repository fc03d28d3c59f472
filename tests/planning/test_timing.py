"""Timing of paths: limits kept, known durations, files that others can read."""

import io
import json

import numpy as np
import pandas as pd
import pinocchio as pin
import pytest
import yaml

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import InputError
from dualarm_repro.planning import truth
from dualarm_repro.planning.tasks.path_file import read_paths
from dualarm_repro.planning.timing import export
from dualarm_repro.planning.timing.timed_motion import timed
from dualarm_repro.scene import JointPath, MovingShape, PlacedArm, PosePath, Scene, Sphere

ARM = load_arm("irb120")


@pytest.fixture(scope="module")
def scene():
    turned = pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, np.pi), np.array([1.6, 0.0, 0.0]))
    return Scene([PlacedArm("left", ARM, pin.SE3.Identity()), PlacedArm("right", ARM, turned)])


def one_joint(scene, way):
    """Only the first joint of the left arm turns, by ``way`` [rad]."""
    there = np.zeros(6)
    there[0] = way
    return {"left": JointPath([np.zeros(6), there]), "right": JointPath([np.zeros(6)])}


@pytest.fixture(scope="module")
def motion(scene):
    """A corner: the second joint first, then the first of the other arm."""
    a, b = np.zeros(6), np.zeros(6)
    a[1], b[0] = 0.6, -0.8
    left, right = [np.zeros(6), a, a], [np.zeros(6), np.zeros(6), b]
    paths = {"left": JointPath(left), "right": JointPath(right)}
    return timed(scene, paths, speed=0.5, acceleration=4.0)


@pytest.mark.parametrize(
    ("way", "acceleration"),
    [(0.2, 4.0), (1.5, 4.0), (2.0, 40.0)],
)
def test_one_joint_takes_the_time_of_a_trapezoid(scene, way, acceleration):
    """T = 2 sqrt(w / a), or w / v + v / a where the speed limit is reached."""
    speed = 0.5 * ARM.velocity_limit[0]
    bang = 2.0 * np.sqrt(way / acceleration)
    right = bang if acceleration * bang / 2.0 <= speed else way / speed + speed / acceleration
    found = timed(scene, one_joint(scene, way), speed=0.5, acceleration=acceleration)
    # limits are kept at the points of a grid, never exceeded
    assert found.duration == pytest.approx(right, rel=0.03)
    assert found.duration >= right * (1 - 1e-3)


def test_limits_are_kept_and_the_ends_are_met_at_rest(scene, motion):
    fastest = 0.5 * np.concatenate([ARM.velocity_limit] * 2)
    assert (np.abs(motion.speed) <= fastest).all()
    assert (np.abs(motion.acceleration) <= 4.0).all()
    assert np.abs(motion.speed[[0, -1]]).max() < 1e-2
    np.testing.assert_array_equal(motion.q[0], np.zeros(12))
    assert motion.q[-1, 1] == 0.6
    assert motion.q[-1, 6] == -0.8
    np.testing.assert_allclose(np.gradient(motion.q, motion.time, axis=0)[5:-5],
                               motion.speed[5:-5], atol=0.1)  # fmt: skip


def test_deviation_from_the_polygon_is_small_and_told(motion):
    assert 0.0 < motion.deviation < 0.02
    assert truth(motion.scene, motion.paths).collision_free


def test_limits_hold_between_the_points_of_the_grid_by_differences(scene):
    """A path of many corners; the rows of the files differ by no more than the limits allow."""
    q = np.cumsum(np.random.default_rng(0).normal(size=(20, 12)) * 0.3, axis=0)
    paths = {"left": JointPath(q[:, :6]), "right": JointPath(q[:, 6:])}
    found = timed(scene, paths, speed=0.7, acceleration=5.0, rate=1000.0)
    step = found.duration / (len(found.time) - 1)
    speed = np.diff(found.q, axis=0) / step
    fastest = 0.7 * np.concatenate([ARM.velocity_limit] * 2)
    assert (np.abs(speed) <= fastest * (1 + 1e-6)).all()
    sharpest = np.abs(np.diff(speed, axis=0)).max() / step
    assert 0.97 * 5.0 < sharpest <= 5.0 * (1 + 1e-6)
    assert max(found.fullest_speed, found.fullest_acceleration) == pytest.approx(1.0, abs=1e-6)
    assert max(found.fullest_speed, found.fullest_acceleration) <= 1.0


def test_deviation_bounds_every_sample(scene):
    q = np.cumsum(np.random.default_rng(1).normal(size=(4, 12)) * 0.3, axis=0)
    paths = {"left": JointPath(q[:, :6]), "right": JointPath(q[:, 6:])}
    found = timed(scene, paths, rate=2000.0)
    start, step = q[:-1], np.diff(q, axis=0)
    worst = 0.0
    for row in found.q:
        share = np.clip(((row - start) * step).sum(axis=1) / (step**2).sum(axis=1), 0.0, 1.0)
        away = np.linalg.norm(start + share[:, np.newaxis] * step - row, axis=1)
        worst = max(worst, float(away.min()))
    assert worst / np.sqrt(12) <= found.deviation  # of any joint, at most the Euclidean distance


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"speed": 0.0}, "speed"),
        ({"speed": 1.5}, "at most 1"),
        ({"acceleration": -1.0}, "acceleration"),
        ({"acceleration": float("nan")}, "acceleration"),
        ({"rate": 0.0}, "rate"),
        ({"rate": 3.0}, "rate = 3.0: expected at least 25 samples a second"),
        ({"rate": 1e9}, "at most 200000 samples"),
        ({"speed": 1e-6}, "at most 200000 samples"),
    ],
)
def test_wrong_limits_are_named(scene, change, told):
    with pytest.raises(InputError, match=told):
        timed(scene, one_joint(scene, 0.2), **change)


def test_a_path_that_rests_and_obstacles_that_move_are_refused(scene):
    with pytest.raises(InputError, match="an arm moves"):
        timed(scene, one_joint(scene, 0.0))
    track = PosePath([pin.SE3.Identity()] * 2, [0.0, 9.0])
    moving = Scene(scene.arms, moving={"ball": MovingShape(Sphere([0.0, 0.0, 3.0], 0.1), track)})
    with pytest.raises(InputError, match="ball"):
        timed(moving, one_joint(scene, 0.2))


def test_csv_is_read_by_check_and_holds_tips(scene, motion, tmp_path):
    file = tmp_path / "timed.csv"
    file.write_text(export.to_csv(motion), encoding="utf-8")
    read = read_paths(scene, [file])
    for name, path in motion.paths.items():
        np.testing.assert_allclose(read[name].at(motion.time), path.at(motion.time), atol=1e-5)
    table = pd.read_csv(io.StringIO(export.to_csv(motion)))
    tip = ARM.fk(motion.q[-1, :6])[:3, 3]
    np.testing.assert_allclose(table.iloc[-1][["left.x", "left.y", "left.z"]], tip, atol=1e-5)


def test_json_holds_the_same(motion):
    made = json.loads(export.to_json(motion))
    assert len(made["joint_names"]) == 12
    assert made["joint_names"][0].startswith("left_")
    np.testing.assert_allclose(made["joints_rad"], motion.q, atol=1e-6)
    np.testing.assert_allclose(made["speeds_rad_per_s"], motion.speed, atol=1e-6)


def test_yaml_has_the_fields_of_a_joint_trajectory(motion):
    made = yaml.safe_load(export.to_joint_trajectory(motion))
    assert set(made) == {"header", "joint_names", "points"}
    first, last = made["points"][0], made["points"][-1]
    assert set(first) == {"positions", "velocities", "accelerations", "time_from_start"}
    assert first["time_from_start"] == {"sec": 0, "nanosec": 0}
    stamp = last["time_from_start"]
    assert stamp["sec"] + 1e-9 * stamp["nanosec"] == pytest.approx(motion.duration, abs=1e-6)
    times = [p["time_from_start"]["sec"] * 10**9 + p["time_from_start"]["nanosec"]
             for p in made["points"]]  # fmt: skip
    assert (np.diff(times) > 0).all()
    assert len(first["positions"]) == len(made["joint_names"]) == 12
