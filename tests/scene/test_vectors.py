import numpy as np
from hypothesis import given

from dualarm_repro.scene import vectors
from examples import placements, points, thorough


@given(points, points, placements)
@thorough
def test_algebra_is_that_of_numpy(a, b, placement):
    R = placement.rotation
    np.testing.assert_allclose(vectors.minus(a, b), np.subtract(a, b))
    np.testing.assert_allclose(vectors.along(a, 0.3, b), np.add(a, 0.3 * np.array(b)))
    np.testing.assert_allclose(vectors.scaled(-2.0, a), -2 * np.array(a))
    np.testing.assert_allclose(vectors.dot(a, b), np.dot(a, b), atol=1e-15)
    np.testing.assert_allclose(vectors.cross(a, b), np.cross(a, b), atol=1e-15)
    np.testing.assert_allclose(vectors.rotated(R, a), R @ a, atol=1e-15)
    np.testing.assert_allclose(vectors.rotated_back(R, a), R.T @ a, atol=1e-15)


@given(points)
@thorough
def test_perpendicular_is_a_unit_normal(u):
    n = vectors.perpendicular(u)
    assert abs(np.linalg.norm(n) - 1) < 1e-15
    assert abs(np.dot(n, u)) < 1e-15


def test_perpendicular_to_nothing_is_up():
    assert vectors.perpendicular((0.0, 0.0, 0.0)) == (0.0, 0.0, 1.0)
