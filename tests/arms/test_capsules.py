"""Capsules: where the table puts them, and that derived ones enclose the shapes."""

import coal
import numpy as np
import pinocchio as pin
import pytest
from example_robot_data import getModelPath
from numpy.testing import assert_allclose

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.capsules import enclosing_capsules

FREE_FLOATING = pin.SE3(pin.rpy.rpyToMatrix(0.4, -0.7, 1.1), np.array([0.3, -0.2, 0.5]))


def ends(item):
    """Ends of the segment of a capsule in the frame of its joint."""
    half = np.array([0, 0, item.geometry.halfLength])
    return item.placement.act(-half), item.placement.act(half)


def gap(points, item):
    """How far points lie outside of a capsule [m], negative inside."""
    start, end = ends(item)
    axis = end - start
    along = np.clip((points - start) @ axis / max(axis @ axis, 1e-30), 0, 1)
    return np.linalg.norm(points - start - along[:, None] * axis, axis=1) - item.geometry.radius


def in_world(arm, q):
    data = arm.model.createData()
    pin.forwardKinematics(arm.model, data, np.array(q))
    return [
        [data.oMi[item.parentJoint].act(end) for end in ends(item)]
        for item in arm.geometry.geometryObjects
    ]


def test_capsules_of_a_table_follow_its_links(rng):
    for name in ("irb120", "er16", "es165d", "es165d-public", "kr16-2", "irb2400", "es165d-slave"):
        arm = load_arm(name)
        q = arm.random_configurations(1, rng)[0]
        points, segments = arm.joint_positions(q), np.array(in_world(arm, q))
        for item, segment in zip(arm.geometry.geometryObjects, segments, strict=True):
            assert isinstance(item.geometry, coal.Capsule)
            away = np.linalg.norm(points[:, None] - segment, axis=2).min(axis=0)
            on_axis_1 = np.hypot(*segment[:, :2].T).max() < 1e-12
            assert on_axis_1 or away.min() < 1e-12, "from joint to joint, but for the base"
            assert item.geometry.radius > 0.03
        # From the shoulder outwards the segments form one chain that ends in the flange.
        assert_allclose(segments[-1, 1], points[-1], atol=1e-12)
        for before, after in zip(segments[-4:-1], segments[-3:], strict=True):
            assert np.linalg.norm(before[:, None] - after, axis=2).min() < 1e-12


def test_mirrored_capsules(rng):
    arm = load_arm("es165d")
    q = arm.random_configurations(1, rng)[0]
    image = in_world(arm.mirrored(), -q)
    assert_allclose(image, np.array(in_world(arm, q)) * (1, -1, 1), atol=1e-12)


def mesh():
    rng = np.random.default_rng(3)
    points = rng.normal(size=(200, 3)) * (0.02, 0.05, 0.2)
    vertices = coal.StdVec_Vec3s()
    vertices.extend(list(points))
    return coal.Convex.convexHull(vertices, True, "Qt"), points


def box():
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return coal.Box(0.1, 0.5, 0.2), corners * (0.05, 0.25, 0.1)


def cylinder():
    turn = np.linspace(0, 2 * np.pi, 50)
    rim = np.column_stack([0.1 * np.cos(turn), 0.1 * np.sin(turn)])
    return coal.Cylinder(0.1, 0.3), np.vstack([np.c_[rim, 0 * turn + z] for z in (-0.15, 0.15)])


@pytest.mark.parametrize("shape", [mesh, box, cylinder])
def test_enclosing(shape):
    geometry, points = shape()
    shapes = pin.GeometryModel()
    shapes.addGeometryObject(pin.GeometryObject("shape", 0, FREE_FLOATING, geometry))
    (capsule,) = enclosing_capsules(shapes).geometryObjects
    outside = gap(np.array([FREE_FLOATING.act(point) for point in points]), capsule)
    assert outside.max() < 1e-12
    assert outside.max() > -1e-9, "no thicker than it has to be"
    if shape is not cylinder:  # whose length is kept
        capsule.geometry.halfLength -= 1e-3
        outside = gap(np.array([FREE_FLOATING.act(point) for point in points]), capsule)
        assert outside.max() > 1e-7, "no longer than it has to be"


def test_spheres_and_capsules_stay_and_contained_ones_go():
    shapes = pin.GeometryModel()
    shift = pin.SE3(np.eye(3), np.array([0.0, 0.0, 0.25]))
    for name, joint, placement, geometry in [
        ("end", 0, shift, coal.Sphere(0.1)),
        ("long", 0, pin.SE3.Identity(), coal.Capsule(0.1, 0.5)),
        ("same", 0, pin.SE3.Identity(), coal.Capsule(0.1, 0.5)),
        ("thick", 0, shift, coal.Sphere(0.11)),
        ("other joint", 1, shift, coal.Sphere(0.1)),
    ]:
        shapes.addGeometryObject(pin.GeometryObject(name, joint, placement, geometry))
    kept = {item.name: item for item in enclosing_capsules(shapes).geometryObjects}
    assert set(kept) == {"long", "thick", "other joint"}
    assert kept["long"].geometry.halfLength == 0.25
    assert kept["thick"].geometry.halfLength == 0.0
    assert_allclose(kept["thick"].placement.translation, (0, 0, 0.25))


@pytest.mark.parametrize("name", ["panda", "xarm7", "ur5"])
def test_capsules_of_a_urdf_enclose_its_meshes(name, rng):
    """All vertices lie in some capsule, but for two parts of the collision model of the panda."""
    files = {
        "panda": "panda_description/urdf/panda.urdf",
        "xarm7": "xarm_description/urdf/xarm7.urdf",
        "ur5": "ur_description/urdf/ur5_robot.urdf",
    }
    sticking_out = {"panda_hand_0": 7e-3, "panda_link0_0": 11e-3}
    arm = load_arm(name)
    capsules = arm.geometry.geometryObjects
    assert {type(item.geometry) for item in capsules} == {coal.Capsule}
    share, path = getModelPath(files[name]), files[name]
    model = pin.buildModelFromUrdf(f"{share}/{path}")
    shapes = pin.buildGeomFromUrdf(
        model, f"{share}/{path}", pin.GeometryType.COLLISION, package_dirs=[f"{share}/../.."]
    )
    data = arm.model.createData()
    for q in arm.random_configurations(3, rng):
        pin.forwardKinematics(arm.model, data, q)
        for shape in shapes.geometryObjects:
            if isinstance(shape.geometry, coal.BVHModelBase) and "finger" not in shape.name:
                pose = data.oMi[shape.parentJoint] * shape.placement
                points = np.array(shape.geometry.vertices()) @ pose.rotation.T + pose.translation
                frames = [data.oMi[capsule.parentJoint] for capsule in capsules]
                outside = [
                    gap((points - frame.translation) @ frame.rotation, capsule)
                    for frame, capsule in zip(frames, capsules, strict=True)
                ]
                assert np.min(outside, axis=0).max() < sticking_out.get(shape.name, 1e-9)
