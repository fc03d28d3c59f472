"""Parts of shapes: which have a hull, and what it is."""

import coal
import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms.capsules import to_segment
from dualarm_repro.arms.fit.parts import parts_of
from dualarm_repro.arms.fit.triangles import convex, surface_of, triangles_of


def solid(geometry):
    """A model with one shape, off the frame of its joint."""
    made = pin.GeometryModel()
    at = pin.SE3(pin.rpy.rpyToMatrix(0.1, 0.2, 0.3), np.array([0.1, 0.2, 0.3]))
    made.addGeometryObject(pin.GeometryObject("l_0", 1, at, geometry))
    return made


def test_hulls_are_between_the_shape_and_its_capsules():
    model = solid(surface_of(triangles_of(coal.Box(0.3, 0.2, 0.1))))
    parts = parts_of(model)
    assert len(parts) > 1
    for part in parts:
        capsule = part.capsule
        gap = to_segment(part.corners, capsule.start, capsule.end).max()
        assert gap == pytest.approx(capsule.radius, abs=1e-12)
    shape = model.geometryObjects[0]
    corners = [shape.placement.actInv(p) for part in parts for p in part.corners]
    assert np.abs(corners).max(axis=0) == pytest.approx([0.15, 0.1, 0.05], abs=1e-9)


def test_the_prism_of_a_cylinder_touches_it_all_around():
    """n sides of 2 r tan(pi / n) a height, and as many triangles of r^2 tan(pi / n) at each end."""
    a, b, c = np.moveaxis(triangles_of(coal.Cylinder(0.2, 0.7)), 1, 0)
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    side = 0.2 * np.tan(np.pi / 24)
    assert area == pytest.approx(24 * (2 * side * 0.7 + 2 * side * 0.2), rel=1e-12)


@pytest.mark.parametrize("geometry", [coal.Sphere(0.1), coal.Capsule(0.1, 0.4)])
def test_balls_and_capsules_are_their_own_hull(geometry):
    (part,) = parts_of(solid(geometry))
    assert part.corners.shape == (0, 3)
    assert part.content is geometry or type(part.content) is type(geometry)


def test_a_flat_mesh_has_a_capsule_and_no_hull():
    square = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]])
    assert all(len(part.corners) == 0 for part in parts_of(solid(surface_of(0.1 * square))))


@pytest.mark.parametrize("height", [1e-1, 1e-4, 1e-6, 1e-9])
@pytest.mark.usefixtures("seeded")
def test_distance_of_a_thin_body(height):
    """A plate of 1 m in the plane z = 0 and a ball of 0.1 m around (0, 0, 1)."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (0, -height)]) * 0.5
    turned = pin.SE3.Random()
    body = convex(np.array([turned.act(p) for p in corners]))
    at = turned.act(np.array([0.0, 0.0, 1.0]))
    ends = coal.Transform3s(), coal.Transform3s(np.eye(3), at)
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    found = coal.distance(body, ends[0], coal.Sphere(0.1), ends[1], request, result)
    assert found == pytest.approx(0.9, abs=1e-5)


@pytest.fixture
def seeded():
    """Placements of this test."""
    pin.seed(3)
