"""Distances of links of one arm by hulls: between those of the capsules and of the shapes."""

from importlib import import_module
from pathlib import Path

import coal
import numpy as np
import pinocchio as pin
import pytest
from example_robot_data import getModelPath

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.fit.evidence import contacts, home_pose, watched_pairs
from dualarm_repro.scene import PlacedArm, Scene, clearance, clearance_gradient, distances
from dualarm_repro.scene.certificate import certified_minimum
from dualarm_repro.scene.hull_pairs import CAP, hull_pairs, hulls_of
from dualarm_repro.scene.placement import arm_frames
from dualarm_repro.scene.shapes import Sphere
from dualarm_repro.scene.tool import with_tool

ARMS = {
    "ur3": "ur_description/urdf/ur3_robot.urdf",
    "ur5": "ur_description/urdf/ur5_robot.urdf",
    "ur10": "ur_description/urdf/ur10_robot.urdf",
    "panda": "panda_description/urdf/panda.urdf",
}


def public(name):
    """An arm of example-robot-data."""
    return load_arm(Path(getModelPath(ARMS[name])) / ARMS[name])


@pytest.fixture(scope="module")
def ur5():
    """A scene of one UR5, turned and off the origin, and postures in it."""
    base = pin.SE3(pin.rpy.rpyToMatrix(0.3, -0.2, 1.0), np.array([0.4, -0.1, 0.7]))
    arm = public("ur5")
    scene = Scene([PlacedArm("a", arm, base)])
    return scene, arm.random_configurations(300, np.random.default_rng(2))


@pytest.fixture
def capsules_alone(monkeypatch):
    """Distances without hulls."""

    def measured(scene, q):
        with monkeypatch.context() as patch:
            module = import_module("dualarm_repro.scene.clearance")
            patch.setattr(module, "refine", lambda *_: None)
            return distances(scene, q)

    return measured


@pytest.mark.parametrize("name", ARMS)
def test_real_contacts_are_found_and_few_clear_postures_are_refused(name):
    """Contact of the meshes in other postures than those the evidence is from."""
    arm = public(name)
    q = arm.random_configurations(500, np.random.default_rng(4711))
    real = contacts(arm.model, arm.solids, watched_pairs(arm.solids), q).any(axis=1)
    flagged = (distances(Scene([PlacedArm("a", arm)]), q) <= 0.0).any(axis=1)
    assert real.sum() > 30
    assert flagged[real].all(), "no contact of the meshes is lost"
    assert flagged[~real].mean() <= 0.05


@pytest.mark.parametrize("name", ["ur5", "ur10"])
def test_home_poses_are_accepted(name):
    arm = public(name)
    assert distances(Scene([PlacedArm("a", arm)]), home_pose(arm.model)).min() > 0.0


def test_no_distance_is_below_capsules_or_beyond_shapes(ur5, capsules_alone):
    scene, q = ur5
    (placed,) = scene.arms
    arm, found, before = placed.arm, distances(scene, q), capsules_alone(scene, q)
    assert (found >= before).all()
    raised = found > before
    assert raised.any()
    assert (before[raised] < CAP).all()
    assert (found[raised] <= CAP).all()
    pairs = watched_pairs(arm.solids)
    for i, j in pairs:
        arm.solids.addCollisionPair(pin.CollisionPair(i, j))
    data, geometry = arm.model.createData(), arm.solids.createData()
    for row, nearest in zip(q[:60], found[:60].min(axis=1), strict=True):
        pin.computeDistances(arm.model, data, arm.solids, geometry, row)
        true = min(one.min_distance for one in geometry.distanceResults)
        if true > 0.0:
            assert nearest <= true + 1e-9
    arm.solids.removeAllCollisionPairs()


def test_hulls_lie_in_their_capsules_and_where_the_links_are(ur5):
    scene, q = ur5
    (placed,) = scene.arms
    joint, hull, _ = hulls_of(placed.arm)["forearm_link_0.0"]
    corners = placed.arm.hulls["forearm_link_0.0"]
    data = placed.arm.model.createData()
    pin.forwardKinematics(placed.arm.model, data, q[0])
    world = np.array([placed.placement.act(data.oMi[joint].act(p)) for p in corners])
    frame = arm_frames(scene, q[:1])[0][0, joint]
    mine = np.array(hull.points()) @ frame[:, :3].T + frame[:, 3]
    gap = np.linalg.norm(mine[:, None] - world[None], axis=2).min(axis=1)
    assert gap.max() < 1e-9


def test_points_and_gradients_belong_to_the_hulls(ur5, capsules_alone):
    scene, q = ur5
    before = capsules_alone(scene, q)
    found, gradient = clearance_gradient(scene, q)
    rows, columns = np.nonzero((found.distance > before + 1e-6) & (found.distance < CAP - 1e-6))
    assert len(rows) > 20
    at = found.point_a + found.distance[..., None] * found.normal
    assert found.point_b == pytest.approx(at, abs=1e-9)
    step, near = 1e-6, 0
    for n, k in zip(rows[:20], columns[:20], strict=True):
        turned = q[n] + step * np.vstack([np.eye(6), -np.eye(6)])
        d = distances(scene, turned)[:, k]
        slope = (d[:6] - d[6:]) / (2.0 * step)
        near += np.abs(slope - gradient[n, k]).max() < 0.02
    assert near >= 15, "but where another corner or face becomes the nearest"


def test_a_certified_bound_holds_between_samples(ur5):
    scene, q = ur5
    path = np.array([q[0], q[0] + 0.3 * (q[1] - q[0])])
    bracket = certified_minimum(scene, path, tolerance=2e-3)
    between = path[0] + np.linspace(0, 1, 400)[:, None] * (path[1] - path[0])
    least = distances(scene, between).min()
    assert bracket.lower <= least + 1e-9
    assert bracket.upper <= least + 2e-3


def test_a_thicker_capsule_has_no_hull_and_a_tool_keeps_the_others(ur5):
    (placed,) = ur5[0].arms
    arm = placed.arm

    def thicker():
        made = pin.GeometryModel()
        for one in arm.geometry.geometryObjects:
            solid = coal.Capsule(one.geometry.radius + 0.01, 2.0 * one.geometry.halfLength)
            made.addGeometryObject(
                pin.GeometryObject(one.name, one.parentJoint, one.placement, solid)
            )
        return made

    assert hulls_of(arm)
    assert hulls_of(arm.reshaped(thicker)) == {}
    assert hulls_of(with_tool(arm, [Sphere((0, 0, 0.05), 0.04)])).keys() == hulls_of(arm).keys()


def test_arms_of_tables_have_none():
    scene = Scene([PlacedArm("a", load_arm("irb120"))])
    assert hull_pairs(scene) == {}
    q = np.zeros((1, 6))
    assert clearance(scene, q).distance.shape == (1, len(scene.pairs))
