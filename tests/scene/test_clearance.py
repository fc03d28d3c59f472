import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.scene import (
    Capsule,
    HalfSpace,
    PlacedArm,
    Scene,
    Sphere,
    clearance,
    distances,
    signed_distance,
)
from dualarm_repro.scene.placement import place
from examples import two_arms


def named(placed):
    """Copies of the model and the shapes of an arm, every name led by that of the arm."""
    model, geometry = pin.Model(placed.arm.model), pin.GeometryModel(placed.arm.geometry)
    for k in range(1, model.njoints):
        model.names[k] = f"{placed.name}/{model.names[k]}"
    for entry in [*model.frames, *geometry.geometryObjects]:
        entry.name = f"{placed.name}/{entry.name}"
    for shape in geometry.geometryObjects:  # appendModel follows the frame of each shape
        joint = shape.parentJoint
        shape.parentFrame = [frame.parentJoint for frame in model.frames].index(joint)
    return model, geometry


def pinocchio_twin(scene):
    """The scene as one Pinocchio model in the base frame of the left arm, with the same pairs."""
    left, right = scene.arms
    (model_l, shapes_l), (model_r, shapes_r) = named(left), named(right)
    to_left = left.placement.inverse()
    model, geometry = pin.appendModel(
        model_l, model_r, shapes_l, shapes_r, 0, to_left * right.placement
    )
    solids = {"floor": (HalfSpace((0, 0, 1), scene.floor),)}
    for name, shape in scene.obstacles.items():
        solids[name] = shape if isinstance(shape, tuple) else (shape,)
    for name, parts in solids.items():
        for k, part in enumerate(parts):
            form, pose = part.coal()
            placement = to_left * pin.SE3(pose.getRotation(), pose.getTranslation())
            full = name if len(parts) == 1 else f"{name}/{k}"
            geometry.addGeometryObject(pin.GeometryObject(full, 0, placement, form))
    geometry.removeAllCollisionPairs()
    for names in scene.pairs.names:
        geometry.addCollisionPair(pin.CollisionPair(*map(geometry.getGeometryId, names)))
    return model, geometry


def test_agrees_with_pinocchio_on_a_pair_of_irb120():
    """All pairs of both arms, their obstacles, the window, a hull and the floor."""
    scene = two_arms(floor=0.1)
    model, geometry = pinocchio_twin(scene)
    data, geometry_data = model.createData(), geometry.createData()
    for request in geometry_data.distanceRequests:
        request.gjk_tolerance = request.epa_tolerance = 1e-9
    rng = np.random.default_rng(0)
    q = rng.uniform(-1.5, 1.5, (200, 12))
    found = clearance(scene, q)
    for n, configuration in enumerate(q):
        pin.computeDistances(model, data, geometry, geometry_data, configuration)
        expected = [result.min_distance for result in geometry_data.distanceResults]
        np.testing.assert_allclose(found.distance[n], expected, atol=1e-9)
        assert found.minimum[n] == pytest.approx(min(expected), abs=1e-9)
    for owner in ("ball", "pole", "window", "wall", "stone", "floor", "right"):
        some = found.distance[:, scene.pairs.between("left", owner)]
        assert some.min() < 0 < some.max()


def test_witnesses_are_those_of_the_single_pairs():
    scene = two_arms(floor=0.1)
    q = np.random.default_rng(1).uniform(-1.5, 1.5, (10, 12))
    found = clearance(scene, q)
    across = found.point_a + found.distance[..., None] * found.normal
    np.testing.assert_allclose(found.point_b, across, atol=1e-9)
    cores = place(scene, q, np.zeros(10)).cores
    radius = scene.bodies.radius
    for n in range(len(q)):
        for k, (a, b) in enumerate(scene.pairs.bodies):
            if b.sort == "capsule":
                first, second = (Capsule(*cores[n, x.row], radius[x.row]) for x in (a, b))
                single = signed_distance(first, second)
                assert found.distance[n, k] == pytest.approx(single.distance, abs=1e-12)
                np.testing.assert_allclose(found.point_a[n, k], single.point_a, atol=1e-9)


def test_one_and_many_configurations_agree():
    """More configurations than one block, one by one and without witnesses."""
    scene = two_arms(floor=0.1)
    q = np.random.default_rng(2).uniform(-1, 1, (1100, 12))
    many, bare = clearance(scene, q), distances(scene, q)
    assert many.distance.shape == (1100, len(scene.pairs))
    np.testing.assert_allclose(bare, many.distance, atol=1e-14)
    for n in (0, 511, 512, 1099):
        one = clearance(scene, q[n])
        assert one.distance.shape == (len(scene.pairs),)
        np.testing.assert_allclose(one.distance, many.distance[n], atol=1e-14)
        np.testing.assert_allclose(one.normal, many.normal[n], atol=1e-12)
        assert one.minimum == pytest.approx(many.minimum[n], abs=1e-14)
        assert one.nearest == many.nearest[n]
        assert one.names[one.nearest] == scene.pairs.names[many.nearest[n]]
        np.testing.assert_allclose(distances(scene, q[n]), bare[n], atol=1e-14)


def test_lists_float32_and_strided_configurations():
    scene = two_arms(obstacles=False)
    q = np.linspace(-1, 1, 24).reshape(2, 12)
    wide = np.zeros((4, 24))
    wide[::2, ::2] = q
    expected = distances(scene, q)
    np.testing.assert_allclose(distances(scene, q.tolist()), expected)
    np.testing.assert_allclose(distances(scene, wide[::2, ::2]), expected)
    np.testing.assert_allclose(distances(scene, q.astype("f4")), expected, atol=1e-5)


def test_arms_can_be_swapped():
    scene = two_arms(obstacles=False)
    other = Scene(scene.arms[::-1])
    q = np.random.default_rng(3).uniform(-1, 1, (20, 12))
    swapped = np.hstack([q[:, 6:], q[:, :6]])
    found = clearance(other, swapped).minimum
    np.testing.assert_allclose(found, clearance(scene, q).minimum, atol=1e-12)


def test_no_pair_no_limit():
    arm = two_arms().arms[0]
    scene = Scene([PlacedArm("arm", arm.arm)], self_collision=False)
    assert len(scene.pairs) == 0
    assert clearance(scene, np.zeros(6)).minimum == np.inf
    np.testing.assert_array_equal(clearance(scene, np.zeros((3, 6))).minimum, [np.inf] * 3)


def test_no_configuration():
    scene = two_arms()
    assert clearance(scene, np.empty((0, 12))).distance.shape == (0, len(scene.pairs))


def test_distance_is_lipschitz_in_the_position_of_an_obstacle():
    arm = two_arms().arms[0]
    q = np.random.default_rng(4).uniform(-1, 1, (50, 6))
    here, there = np.array([0.4, 0.1, 0.5]), np.array([0.42, 0.1, 0.47])
    found = [
        clearance(Scene([arm], {"ball": Sphere(center, 0.1)}), q).minimum
        for center in (here, there)
    ]
    assert np.abs(np.subtract(*found)).max() <= np.linalg.norm(here - there) + 1e-12
