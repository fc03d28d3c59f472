"""Obstacles as parts: what is drawn lies on the surface that distances are measured to."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.scene import Box, Capsule, ConvexHull, HalfSpace, Sphere
from dualarm_repro.scene.distance import signed_distance
from dualarm_repro.view.scenes.solid_parts import half_space_part, solid_part
from dualarm_repro.view.scenes.surfaces import surface

TURN = pin.rpy.rpyToMatrix(0.3, -0.5, 1.2)
SHAPES = {
    "sphere": Sphere([0.5, 0.1, 0.5], 0.1),
    "capsule": Capsule([0.5, 0.0, 0.5], [0.2, 0.2, 0.9], 0.1),
    "box": Box([0.5, 0.0, 0.5], [0.1, 0.2, 0.3], TURN),
    "hull": ConvexHull(np.vstack([np.zeros(3), 0.2 * np.eye(3)]) + 0.5),
}
_PROBE = 1e-3


@pytest.mark.parametrize("name", SHAPES)
def test_vertices_lie_on_the_shape(name):
    part = solid_part(name, SHAPES[name], "#9A9A9A")
    gaps = [
        signed_distance(Sphere(vertex, _PROBE), SHAPES[name]).distance + _PROBE
        for vertex in surface(part).vertices[::3]
    ]
    np.testing.assert_allclose(gaps, 0.0, atol=1e-9)
    assert part.body == name
    assert part.node == "world"
    assert part.color == "#9A9A9A"


def support(shape, unit):
    """How far a shape reaches along a direction."""
    match shape:
        case Sphere():
            return shape.center @ unit + shape.radius
        case Capsule():
            return max(shape.start @ unit, shape.end @ unit) + shape.radius
        case Box():
            return shape.center @ unit + abs(shape.rotation.T @ unit) @ (0.5 * shape.size)
        case _:
            return (shape.vertices @ unit).max()


@pytest.mark.parametrize("name", SHAPES)
def test_the_whole_shape_is_drawn(name):
    """Along many directions the drawing reaches as far as the shape, up to its facets."""
    shape, rng = SHAPES[name], np.random.default_rng(2)
    vertices = surface(solid_part(name, shape, "#9A9A9A")).vertices
    for direction in rng.normal(size=(20, 3)):
        unit = direction / np.linalg.norm(direction)
        reach, drawn = support(shape, unit), (vertices @ unit).max()
        assert drawn <= reach + 1e-9
        assert drawn > reach - 0.003  # 28 facets around a radius of 0.1 m


UNITS = st.tuples(*[st.floats(-1.0, 1.0)] * 3).map(np.array).filter(lambda v: np.dot(v, v) > 0.01)


@settings(max_examples=30)
@given(UNITS, st.floats(-1.0, 1.0), st.tuples(*[st.floats(-2.0, 2.0)] * 3).map(np.array))
def test_a_plane_is_a_square_nearest_to_where_it_matters(normal, offset, middle):
    plane = HalfSpace(normal, offset)
    part = half_space_part("wall", plane, "#9A9A9A", middle, 2.0)
    heights = part.vertices @ plane.normal - plane.offset
    np.testing.assert_allclose(heights, 0.0, atol=1e-9)
    centre = part.vertices.mean(axis=0)
    np.testing.assert_allclose(np.cross(centre - middle, plane.normal), 0.0, atol=1e-9)
    sides = np.linalg.norm(part.vertices - np.roll(part.vertices, -1, axis=0), axis=1)
    np.testing.assert_allclose(sides, 2.0)
    diagonals = np.linalg.norm(part.vertices[:2] - part.vertices[2:], axis=1)
    np.testing.assert_allclose(diagonals, 2.0 * np.sqrt(2.0))
    assert part.opacity < 0.5


def test_a_plane_is_seen_from_both_sides():
    part = solid_part("wall", HalfSpace([0.0, 0.0, 1.0], -0.2), "#9A9A9A")
    corners = part.vertices[part.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert sorted(np.sign(across[:, 2]).tolist()) == [-1.0, -1.0, 1.0, 1.0]
    assert 0.5 * np.linalg.norm(across, axis=1).sum() == pytest.approx(2.0)


def test_a_part_may_be_carried_by_a_node():
    assert solid_part("cart", SHAPES["box"], "#9A9A9A", node="cart").node == "cart"
