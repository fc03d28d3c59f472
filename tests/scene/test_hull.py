import numpy as np
import pytest
from hypothesis import given

from dualarm_repro.errors import InputError
from dualarm_repro.scene import ConvexHull, Sphere, circle_points, point_distances, signed_distance
from examples import placements, seeds, thorough

CUBE = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)


def test_cube():
    hull = ConvexHull(np.vstack([CUBE, [[0.5, 0.5, 0.5]]]))
    assert len(hull.vertices) == 8
    assert hull.faces.shape == (12, 3)
    assert hull.volume == pytest.approx(1)
    probe = [(0.5, 0.5, 0.6), (0.5, 0.5, 2), (2, 2, 0.5), (2, 2, 2), (1, 0.5, 0.5)]
    distance, gradient = point_distances(probe, [hull])
    expected = [-0.4, 1, np.sqrt(2), np.sqrt(3), 0]
    np.testing.assert_allclose(distance[:, 0], expected, atol=1e-12)
    np.testing.assert_allclose(gradient[1, 0], (0, 0, 1), atol=1e-12)
    np.testing.assert_allclose(gradient[3, 0], np.ones(3) / np.sqrt(3), atol=1e-12)


@given(seeds)
@thorough
def test_faces_bound_the_hull(seed):
    rng = np.random.default_rng(seed)
    hull = ConvexHull(rng.normal(size=(20, 3)))
    a, b, c = np.moveaxis(hull.vertices[hull.faces], 1, 0)
    height = np.einsum("fk,fvk->fv", np.cross(b - a, c - a), hull.vertices - a[:, None])
    one_sided = (height < 1e-9).all(axis=1) | (height > -1e-9).all(axis=1)
    assert one_sided.all()


def test_inside_the_distance_is_that_of_the_nearest_face_plane():
    rng = np.random.default_rng(0)
    hull = ConvexHull(rng.normal(size=(30, 3)))
    a, b, c = np.moveaxis(hull.vertices[hull.faces], 1, 0)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    middle = hull.vertices.mean(axis=0)
    normal *= np.sign(np.einsum("fk,fk->f", normal, a - middle))[:, None]
    probe = middle + 0.3 * rng.normal(size=(200, 3))
    heights = np.einsum("fk,pfk->pf", normal, probe[:, None] - a)
    inside = heights.max(axis=1) < 0
    assert inside.sum() > 50
    distance = point_distances(probe[inside], [hull])[0][:, 0]
    np.testing.assert_allclose(distance, heights[inside].max(axis=1), atol=1e-12)


@given(placements)
@thorough
def test_moved_hull(placement):
    hull = ConvexHull(CUBE)
    ball = Sphere((1.5, 1.4, 0.2), 0.1)
    found = signed_distance(ball.moved(placement), hull.moved(placement)).distance
    assert found == pytest.approx(signed_distance(ball, hull).distance, abs=1e-9)


@pytest.mark.parametrize(
    "points",
    [CUBE[:3], CUBE[:4], [[0, 0, 0]] * 6, CUBE[:, :2], [[0, 0, np.nan]] * 5, "cube", []],
)
def test_bad_points(points):
    with pytest.raises(InputError, match=r"ConvexHull: points .*do not lie in one plane"):
        ConvexHull(points)


def test_circles_lie_in_their_planes():
    rng = np.random.default_rng(2)
    centers, axes, radii = rng.normal(size=(4, 3)), rng.normal(size=(4, 3)), rng.uniform(1, 2, 4)
    rings = circle_points(centers, axes, radii, 12).reshape(4, 12, 3)
    spokes = rings - centers[:, None]
    np.testing.assert_allclose(np.linalg.norm(spokes, axis=2), np.repeat(radii[:, None], 12, 1))
    np.testing.assert_allclose(np.einsum("kic,kc->ki", spokes, axes), 0, atol=1e-12)
    steps = np.linalg.norm(np.diff(rings, axis=1), axis=2)
    np.testing.assert_allclose(steps, 2 * radii[:, None] * np.sin(np.pi / 12) * np.ones(11))


def test_two_points_are_no_circle():
    with pytest.raises(InputError, match="count = 2: expected a whole number, at least 3"):
        circle_points([[0, 0, 0]], [[0, 0, 1]], [1], 2)
