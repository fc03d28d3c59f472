import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.errors import InputError
from dualarm_repro.scene import (
    Box,
    Capsule,
    HalfSpace,
    Sphere,
    facing,
    point_distances,
    signed_distance,
    window_frame,
)
from examples import judged, points, shapes, thorough

WINDOW = window_frame((0.1, 0.2, 0.3), facing((1, 0.3, 0.2)), 0.9, 1.1, 0.1, 0.2)
OBSTACLES = [
    Sphere((0, 0, 0), 0.3),
    Capsule((0, 0.5, 0), (0.5, 0.5, 0.2), 0.1),
    HalfSpace((0, 0.2, 1), -0.4),
    *WINDOW,
]


@given(points, shapes)
@thorough
def test_a_point_is_a_sphere_without_its_radius(p, shape):
    distance, gradient = point_distances(p, [shape])
    ball = signed_distance(Sphere(p, 0.01), shape)
    assert distance[0] == pytest.approx(ball.distance + 0.01, abs=1e-9)
    assert np.linalg.norm(gradient[0]) == pytest.approx(1, abs=1e-12)


def test_agrees_with_coal():
    rng = np.random.default_rng(0)
    probe = rng.normal(size=(500, 3))
    distance, gradient = point_distances(probe, OBSTACLES)
    for p, row, normals in zip(probe, distance, gradient, strict=True):
        for shape, d, g in zip(OBSTACLES, row, normals, strict=True):
            expected, normal = judged(Sphere(p, 1e-3), shape)
            assert d - 1e-3 == pytest.approx(expected, abs=1e-9)
            np.testing.assert_allclose(g, -normal, atol=1e-6)


def test_gradient_is_the_derivative_outside_and_inside():
    rng = np.random.default_rng(1)
    probe = 0.6 * rng.normal(size=(2000, 3))
    distance, gradient = point_distances(probe, OBSTACLES)
    assert (distance < 0).any(axis=0).all()
    assert (distance > 0).any(axis=0).all()
    step = 1e-6
    ahead = point_distances(probe[:, None] + step * np.eye(3), OBSTACLES)[0]
    behind = point_distances(probe[:, None] - step * np.eye(3), OBSTACLES)[0]
    numeric = (ahead - behind) / (2 * step)
    np.testing.assert_allclose(np.swapaxes(numeric, 1, 2), gradient, atol=1e-6)


def test_gradient_on_the_surface():
    """Touching points: the central difference across the surface still sees slope one."""
    rng = np.random.default_rng(2)
    probe = 0.6 * rng.normal(size=(500, 3))
    for shape in OBSTACLES:
        distance, gradient = point_distances(probe, [shape])
        feet = probe - distance * gradient[:, 0]
        touching, normal = point_distances(feet, [shape])
        np.testing.assert_allclose(touching, 0, atol=1e-9)
        if isinstance(shape, Box):
            continue  # most feet of outer points lie on edges, where only one side is smooth
        ahead = point_distances(feet + 1e-6 * normal[:, 0], [shape])[0]
        behind = point_distances(feet - 1e-6 * normal[:, 0], [shape])[0]
        np.testing.assert_allclose((ahead - behind) / 2e-6, 1, atol=1e-6)


@given(points)
@thorough
def test_the_window_is_as_near_as_its_nearest_bar(p):
    each = point_distances(p, WINDOW)[0]
    assert each.shape == (4,)
    singles = [point_distances(p, [bar])[0][0] for bar in WINDOW]
    np.testing.assert_array_equal(each, singles)


@given(st.integers(0, 3))
@thorough
def test_shape_of_the_answer(dimensions):
    leading = (2, 3, 4)[:dimensions]
    distance, gradient = point_distances(np.ones((*leading, 3)), OBSTACLES)
    assert distance.shape == (*leading, len(OBSTACLES))
    assert gradient.shape == (*leading, len(OBSTACLES), 3)


def test_center_of_a_sphere_and_of_a_box_have_a_stated_gradient():
    distance, gradient = point_distances(np.zeros(3), [Sphere((0, 0, 0), 0.3)])
    assert distance[0] == -0.3
    np.testing.assert_array_equal(gradient[0], (0, 0, 1))
    distance, gradient = point_distances(np.zeros(3), [Box((0, 0, 0), (1, 1, 0.5))])
    assert distance[0] == -0.25
    np.testing.assert_array_equal(gradient[0], (0, 0, 1))


def test_what_is_no_shape_is_refused():
    with pytest.raises(InputError, match="point_distances: shape = 'wall'"):
        point_distances((0, 0, 0), ["wall"])


@pytest.mark.parametrize("p", [(0, 0), (0, 0, np.nan), [[0, 0, np.inf]], 3.0])
def test_bad_points(p):
    with pytest.raises(InputError, match="point_distances: points"):
        point_distances(p, OBSTACLES)
