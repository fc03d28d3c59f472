from itertools import product

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.errors import InputError
from dualarm_repro.scene import (
    Box,
    Capsule,
    ConvexHull,
    HalfSpace,
    Sphere,
    signed_distance,
)
from examples import (
    capsules,
    half_spaces,
    judged,
    placements,
    points,
    random_box,
    random_capsule,
    random_placement,
    round_shapes,
    shapes,
    thorough,
)

FIRST = {
    "sphere": lambda rng: Sphere(0.4 * rng.normal(size=3), rng.uniform(0.02, 0.2)),
    "capsule": random_capsule,
    "short capsule": lambda rng: random_capsule(rng, 0.1),
}
SECOND = {
    **FIRST,
    "box": random_box,
    "half-space": lambda rng: HalfSpace(rng.normal(size=3), rng.normal()),
    "hull": lambda rng: ConvexHull(0.3 * rng.normal(size=(15, 3))),
}


@pytest.mark.parametrize(("first", "second"), list(product(FIRST, SECOND)))
def test_agrees_with_coal(first, second):
    rng = np.random.default_rng(0)
    signs = set()
    for _ in range(1000):
        a, b = FIRST[first](rng), SECOND[second](rng)
        found = signed_distance(a, b)
        distance, normal = judged(a, b)
        assert found.distance == pytest.approx(distance, abs=1e-9)
        np.testing.assert_allclose(found.normal, normal, atol=1e-6)
        signs.add(np.sign(distance))
    assert signs >= {-1, 1}


@pytest.mark.parametrize("gap", [0.0, 1e-9, -1e-9, 0.01, -0.01])
@pytest.mark.parametrize("second", SECOND)
def test_a_given_gap_is_found_also_in_contact(second, gap):
    """Shifting along the normal changes the distance by the shift (less than the radius here)."""
    rng = np.random.default_rng(1)
    for _ in range(200):
        a, b = random_capsule(rng), SECOND[second](rng)
        found = signed_distance(a, b)
        if found.distance < 0:
            continue
        shift = pin.SE3(np.eye(3), (found.distance - gap) * found.normal)
        moved = signed_distance(a.moved(shift), b)
        assert moved.distance == pytest.approx(gap, abs=1e-12)
        np.testing.assert_allclose(moved.normal, found.normal, atol=1e-6)


@given(round_shapes, shapes)
@thorough
def test_the_translation_along_the_normal_separates(a, b):
    """Moved out by the penetration depth the shapes touch, a bit more and they part."""
    found = signed_distance(a, b)
    for extra in (0.0, 1e-3):
        out = pin.SE3(np.eye(3), (min(found.distance, 0.0) - extra) * found.normal)
        moved = signed_distance(a.moved(out), b).distance
        assert moved == pytest.approx(max(found.distance, 0.0) + extra, abs=1e-9)


@given(round_shapes, shapes)
@thorough
def test_witness(a, b):
    found = signed_distance(a, b)
    assert np.linalg.norm(found.normal) == pytest.approx(1, abs=1e-12)
    across = found.point_a + found.distance * found.normal
    np.testing.assert_allclose(found.point_b, across, atol=1e-9)
    for point, shape in ((found.point_a, a), (found.point_b, b)):
        on_surface = signed_distance(Sphere(point, 1e-6), shape).distance + 1e-6
        assert on_surface == pytest.approx(0, abs=1e-8)


@given(round_shapes, shapes)
@thorough
def test_symmetry(a, b):
    found, other = signed_distance(a, b), signed_distance(b, a)
    assert found.distance == pytest.approx(other.distance, abs=1e-12)
    if not isinstance(b, Sphere | Capsule):
        np.testing.assert_array_equal(found.point_a, other.point_b)
        np.testing.assert_array_equal(found.normal, -other.normal)


@given(round_shapes, shapes, placements)
@thorough
def test_rigid_motion_changes_nothing(a, b, placement):
    found = signed_distance(a, b)
    moved = signed_distance(a.moved(placement), b.moved(placement))
    assert moved.distance == pytest.approx(found.distance, abs=1e-9)


@given(round_shapes, shapes, points)
@thorough
def test_distance_is_1_lipschitz_in_translation(a, b, shift):
    moved = signed_distance(a.moved(pin.SE3(np.eye(3), np.array(shift))), b)
    change = abs(moved.distance - signed_distance(a, b).distance)
    assert change <= np.linalg.norm(shift) + 1e-12


def scaled(shape, factor):
    match shape:
        case Sphere():
            return Sphere(factor * shape.center, factor * shape.radius)
        case Capsule():
            return Capsule(factor * shape.start, factor * shape.end, factor * shape.radius)
        case Box():
            return Box(factor * shape.center, factor * shape.size, shape.rotation)
        case HalfSpace():
            return HalfSpace(shape.normal, factor * shape.offset)
        case ConvexHull():
            return ConvexHull(factor * shape.vertices)


@given(round_shapes, shapes, st.floats(0.1, 10))
@thorough
def test_distance_scales_with_length(a, b, factor):
    found = signed_distance(scaled(a, factor), scaled(b, factor)).distance
    assert found == pytest.approx(factor * signed_distance(a, b).distance, abs=1e-8)


@given(capsules, half_spaces)
@thorough
def test_half_space_is_the_lower_end(capsule, half_space):
    height = capsule.core @ half_space.normal - half_space.offset
    found = signed_distance(capsule, half_space)
    assert found.distance == pytest.approx(height.min() - capsule.radius, abs=1e-12)
    np.testing.assert_array_equal(found.normal, -half_space.normal)


def test_level_capsule_touches_the_floor_in_its_middle():
    found = signed_distance(Capsule((0, 0, 1), (2, 0, 1), 0.25), HalfSpace((0, 0, 1), 0))
    np.testing.assert_allclose(found.point_a, (1, 0, 0.75))
    np.testing.assert_allclose(found.point_b, (1, 0, 0))


def test_capsules_whose_cores_cross_part_by_the_sum_of_the_radii():
    rng = np.random.default_rng(2)
    for _ in range(100):
        middle, u, v = rng.normal(size=(3, 3))
        a, b = Capsule(middle - u, middle + u, 0.2), Capsule(middle - v, middle + v, 0.1)
        found = signed_distance(a, b)
        assert found.distance == pytest.approx(-0.3, abs=1e-12)
        out = pin.SE3(np.eye(3), found.distance * found.normal)
        assert signed_distance(a.moved(out), b).distance == pytest.approx(0, abs=1e-12)


def test_coinciding_spheres_part_upwards():
    found = signed_distance(Sphere((1, 2, 3), 0.5), Sphere((1, 2, 3), 0.25))
    assert found.distance == -0.75
    np.testing.assert_array_equal(found.normal, (0, 0, 1))


def test_normal_is_continuous_through_contact_and_penetration():
    """A capsule sinking into a box keeps its normal, also when its core enters the box."""
    rng = np.random.default_rng(3)
    box = Box((0, 0, 0), (1, 1, 1), random_placement(rng).rotation)
    up = box.rotation[:, 2]
    tilted = box.rotation @ np.array([0.3, 0.1, 0.05])
    for height in np.linspace(0.8, 0.3, 101):
        start = height * up
        found = signed_distance(Capsule(start, start + tilted, 0.1), box)
        assert found.distance == pytest.approx(height - 0.5 - 0.1, abs=1e-12)
        np.testing.assert_allclose(found.normal, -up, atol=1e-9)


def test_what_is_no_shape_is_refused():
    ball = Sphere((0, 0, 0), 1)
    with pytest.raises(InputError, match="signed_distance: b = 'wall': expected Sphere"):
        signed_distance(ball, "wall")
    with pytest.raises(InputError, match="signed_distance: a = 'wall': expected Sphere"):
        signed_distance("wall", ball)


def test_two_boxes_are_refused():
    box = Box((0, 0, 0), (1, 1, 1))
    with pytest.raises(InputError, match=r"Box, Box.*expected a sphere or capsule among them"):
        signed_distance(box, box)
