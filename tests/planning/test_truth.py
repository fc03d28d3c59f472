"""One truth after any method: certified, over every body, never better than a replay."""

from pathlib import Path

import coal
import numpy as np
import pinocchio as pin
import pytest
from example_robot_data import getModelPath
from own_scenes import LEFT, RIGHT, both, coal_distance, replayed, written

from dualarm_repro.errors import UnknownNameError
from dualarm_repro.planning import load_tasks, plan_file
from dualarm_repro.planning.checks.truth import TOLERANCE, Verdict, truth
from dualarm_repro.scene import JointPath, MovingShape, PosePath, Scene, Sphere


@pytest.fixture(scope="module")
def parked(tmp_path_factory):
    """An arm that sweeps through the place of another one, which has no task."""
    folder = tmp_path_factory.mktemp("parked")
    return written(folder, f"arms:\n  {LEFT}\n  {RIGHT}\n")


def test_a_parked_arm_is_seen_by_the_report(parked):
    """What the planner cannot see is still judged: coal says -0.11 m where the cores cross."""
    found = plan_file(parked, "attraction-only")
    assert set(found.paths) == {"left", "right"}
    judged, right = truth(found.scene, found.paths), replayed(found.scene, found.paths)
    assert right < -0.09
    assert judged.lower <= right <= judged.upper + 2e-3
    assert judged.verdict is Verdict.COLLISION
    assert not judged.collision_free
    assert {name.split("/")[0] for name in judged.pair} == {"left", "right"}


def test_a_parked_arm_is_seen_by_the_planner(parked):
    found = plan_file(parked, "apf-improved")
    names = found.plans["left"].obstacle_names
    assert sum(name.startswith("right/") for name in names) > 4
    judged, right = truth(found.scene, found.paths), replayed(found.scene, found.paths)
    assert judged.lower <= right + 1e-9


@pytest.mark.parametrize("name", ["apf-improved", "apf-bidirectional", "attraction-only"])
def test_report_is_never_better_than_a_replay(tmp_path, name):
    """Two arms and a ball: links against links and ball by coal alone, twelve looks a step."""
    left = 'start: ["60 deg", 0, 0, 0, "30 deg", 0], goal: ["-60 deg", "30 deg", 0, 0, "30 deg", 0]'
    right = 'start: ["60 deg", 0, 0, 0, 0.5, 0], goal: ["-50 deg", "10 deg", 0, 0, 0.5, 0]'
    ball = "obstacles: {ball: {kind: sphere, center: [0.0, -0.05, 0.7], radius: 0.06}}\n"
    path = written(tmp_path, both(left, right, ball + "self_collision: false\n"))
    found = plan_file(path, name)
    judged = truth(found.scene, found.paths)
    solid = (coal.Sphere(0.06), pin.SE3(np.eye(3), np.array([0.0, -0.05, 0.7])))
    right_value = replayed(found.scene, found.paths, [solid], steps=4)
    assert judged.lower <= right_value + 1e-9
    assert judged.upper - judged.lower <= TOLERANCE + 1e-12
    assert right_value - judged.lower < 0.02


def test_exit_of_the_path_waits_for_what_moves(tmp_path):
    """An obstacle that comes when the arm has long arrived still hits it."""
    given = load_tasks(
        written(
            tmp_path,
            both(*["start: [0, 0, 0, 0, 0, 0]"] * 2),
        ),
        goals_needed=False,
    )
    arms = given.scene.arms
    tip = arms[0].placement.act(arms[0].arm.fk(np.zeros(6))[:3, 3])
    poses = [pin.SE3(np.eye(3), tip + np.array([0.0, 3.0, 0.0])), pin.SE3(np.eye(3), tip)]
    ball = MovingShape(Sphere(np.zeros(3), 0.05), PosePath(poses, [0.0, 50.0]))
    scene = Scene(arms, moving={"ball": ball}, self_collision=False)
    paths = {name: JointPath(np.zeros((2, 6))) for name in ("left", "right")}
    judged = truth(scene, paths)
    assert judged.verdict is Verdict.COLLISION
    # contact begins when the ball, not its centre, arrives
    assert judged.index == pytest.approx(50.0, abs=2.0)
    assert "ball" in judged.pair


def test_a_motion_between_the_samples_counts_and_so_do_limits(tmp_path):
    given = load_tasks(written(tmp_path, f"arms:\n  {LEFT}\n  {RIGHT}\n"))
    ends = given.tasks["left"]
    paths = {
        "left": JointPath([ends.start, ends.goal]),
        "right": JointPath([given.parked["right"]]),
    }
    judged = truth(given.scene, paths)
    assert judged.upper < -0.1
    assert 0.0 < judged.index < 1.0
    assert judged.within_limits
    far = ends.goal + np.array([-2.0, 0, 0, 0, 0, 0])
    judged = truth(given.scene, {**paths, "left": JointPath([ends.goal, far])})
    low = given.scene.arms[0].arm.lower[0]
    assert judged.beyond_limits["left"] == pytest.approx(low - far[0])
    assert not judged.within_limits


def test_every_arm_needs_a_path(tmp_path):
    given = load_tasks(written(tmp_path, f"arms:\n  {LEFT}\n  {RIGHT}\n"))
    with pytest.raises(UnknownNameError, match="paths of all of left, right"):
        truth(given.scene, {"left": JointPath(np.zeros((2, 6)))})


def test_near_misses_are_decided_by_a_finer_bracket(tmp_path):
    """A ball 0.3 mm beside a resting and turning forearm is proved clear, and one inside is not."""
    text = "arms: {left: {robot: irb120, start: [0, 0, 0, 0, 0, 0], goal: [0, 0, 0, 1, 0, 0]}}"
    given = load_tasks(written(tmp_path, text))
    (placed,) = given.scene.arms
    bare = Scene([placed], {"ball": Sphere([0.2, 0.5, 0.6], 0.01)}, self_collision=False)
    paths = {"left": JointPath([np.zeros(6), [0, 0, 0, 1.0, 0, 0]])}
    gap = truth(bare, paths).upper
    for left, verdict in ((3e-4, Verdict.FREE), (-3e-4, Verdict.COLLISION)):
        ball = Sphere([0.2, 0.5, 0.6], 0.01 + gap - left)
        scene = Scene([placed], {"ball": ball}, self_collision=False)
        found = truth(scene, paths)
        assert found.verdict is verdict


def test_an_arm_is_never_nearer_to_itself_than_the_report(tmp_path):
    """Postures and a motion of a UR5 alone, some capsules of which are not watched, against its
    collision meshes, placed and measured by Pinocchio and coal alone."""
    urdf = "ur_description/urdf/ur5_robot.urdf"
    file = Path(getModelPath(urdf)) / urdf
    model = pin.buildModelFromUrdf(str(file))
    meshes = pin.buildGeomFromUrdf(
        model, str(file), pin.GeometryType.COLLISION,
        package_dirs=[str(folder) for folder in file.parents],
    )  # fmt: skip
    for i, one in enumerate(meshes.geometryObjects):
        for k, other in enumerate(meshes.geometryObjects[:i]):
            if abs(one.parentJoint - other.parentJoint) > 1:
                meshes.addCollisionPair(pin.CollisionPair(k, i))
    data, measured = model.createData(), meshes.createData()

    def apart(q):
        pin.computeDistances(model, data, meshes, measured, q)
        return min(one.min_distance for one in measured.distanceResults)

    text = f"arms: {{only: {{robot: {file}, start: [0, 0, 0, 0, 0, 0], goal: [0, 0, 0, 0, 0, 1]}}}}"
    (placed,) = load_tasks(written(tmp_path, text)).scene.arms
    scene = Scene([placed])
    free, q = 0, placed.arm.random_configurations(60, np.random.default_rng(9))
    for row in q:
        judged = truth(scene, {"only": JointPath([row])})
        free += judged.collision_free
        assert judged.lower <= max(apart(row), 0.0) + 1e-9
    assert free > 20
    clear = [row for row in q if truth(scene, {"only": JointPath([row])}).collision_free]
    path = JointPath(np.array(clear[:2]))
    judged = truth(scene, {"only": path})
    rows = path.at(np.linspace(0.0, 1.0, 80))
    assert judged.lower <= max(min(map(apart, rows)), 0.0) + 1e-9


def test_meshes_are_never_closer_than_the_report(tmp_path):
    """Two UR5: the collision meshes of their description, placed and measured by Pinocchio and
    coal alone, against the report over capsules."""
    urdf = "ur_description/urdf/ur5_robot.urdf"
    file = Path(getModelPath(urdf)) / urdf
    ends = 'start: ["%s deg", -1.2, 1.2, -1.5, -1.5, 0], goal: ["%s deg", -1.0, 1.4, -1.5, -1.5, 0]'
    text = (
        f"arms:\n  left: {{robot: ur5, xyz: [-0.45, 0, 0], {ends % (70, 20)}}}\n"
        f"  right: {{robot: ur5, xyz: [0.45, 0, 0], rpy: [0, 0, pi], {ends % (80, 70)}}}\n"
        "self_collision: false\n"
    )
    path = written(tmp_path, text)
    found = plan_file(path, "attraction-only", allow_collision=True)
    judged = truth(found.scene, found.paths)
    model = pin.buildModelFromUrdf(str(file))
    folders = [str(folder) for folder in file.parents]
    meshes = pin.buildGeomFromUrdf(
        model, str(file), pin.GeometryType.COLLISION, package_dirs=folders
    )
    data, smallest = model.createData(), np.inf

    def placed(one, q):
        pin.forwardKinematics(model, data, q)
        return [
            (g.geometry, one.placement * data.oMi[g.parentJoint] * g.placement)
            for g in meshes.geometryObjects
        ]

    for time in np.linspace(0.0, found.index[-1], 25):
        left, right = (
            placed(one, found.paths[one.name].at(np.array([time]))[0]) for one in found.scene.arms
        )
        smallest = min(smallest, *(coal_distance(a, b) for a in left for b in right))
    assert np.isfinite(smallest)
    assert judged.lower <= smallest + 1e-6
