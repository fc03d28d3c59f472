"""Hull of joint circles: distances against coal and the readable form, circles, padding."""

import coal
import numpy as np
import pytest
from two_spheres import GOAL, START, placed_arm

from dualarm_repro.planning.field.hull_obstacle import (
    JointCircles,
    circles_on,
    hull_distance,
    hull_track,
    point_hull,
)
from dualarm_repro.scene import ConvexHull

CIRCLES = JointCircles((1, 2, 3, 4, 5, 7), (0.09, 0.09, 0.075, 0.065, 0.05, 0.04), 12)
POSES = np.vstack([np.linspace(START, GOAL, 4), [0.75, 1, -1, 0, 1.57, 0]])


def distance_by_coal(point, solid):
    """Of a ball of radius one around the point, less its radius: coal's GJK and EPA."""
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    ball = coal.Sphere(1.0), coal.Transform3s(np.eye(3), point)
    return coal.distance(*ball, *solid, request, result) + 1.0


@pytest.fixture(scope="module")
def points():
    return circles_on(placed_arm(), CIRCLES, POSES)


def test_distance_equals_coal_and_the_readable_form(points):
    rng = np.random.default_rng(5)
    track = hull_track(points)
    inside = 0
    for row, planes, triangles in zip(points, *track, strict=True):
        solid = ConvexHull(row).coal()
        for point in row.mean(axis=0) + rng.normal(0, 0.25, (60, 3)):
            distance, direction = point_hull(tuple(point), planes, triangles)
            assert distance == pytest.approx(distance_by_coal(point, solid), abs=1e-5)
            readable, gradient = hull_distance(point, planes, triangles)
            assert distance == pytest.approx(readable, abs=1e-12)
            assert direction == pytest.approx(gradient, abs=1e-9)
            inside += distance < 0
            step = 1e-6 * np.asarray(direction)
            further = point_hull(tuple(point + step), planes, triangles)[0]
            assert further - distance == pytest.approx(1e-6, rel=1e-3)
    assert inside > 10


def test_circles_lie_around_the_joints_in_their_planes(points):
    placed = placed_arm()
    for containing in (False, True):
        chosen = CIRCLES._replace(containing_axis=containing)
        rings = circles_on(placed, chosen, POSES).reshape(len(POSES), 6, 12, 3)
        origins = placed.arm.joint_positions(POSES) @ placed.placement.rotation.T
        origins += placed.placement.translation
        centres = origins[:, np.array(CIRCLES.frames) - 1]
        assert rings.mean(axis=2) == pytest.approx(centres, abs=1e-12)
        radius = np.linalg.norm(rings - centres[:, :, None], axis=3)
        assert radius == pytest.approx(
            np.broadcast_to(np.array(CIRCLES.radii)[:, None], radius.shape)
        )
    assert points.shape == (len(POSES), 72, 3)


def test_every_circle_point_is_inside_every_plane(points):
    track = hull_track(points)
    for row, planes in zip(points, track.planes, strict=True):
        assert (row @ planes[:, :3].T + planes[:, 3]).max() < 1e-12
