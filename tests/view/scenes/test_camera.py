"""The camera sees all of the action and wastes little of the picture."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.view.scenes.camera import ASPECT, FIELD, Camera, framed


@pytest.mark.parametrize("direction", [(3.0, -3.0, 2.0), (0.7, -3.2, 2.0), (0.0, 0.0, 1.0)])
@pytest.mark.parametrize("size", [(1.0, 1.0, 1.0), (3.0, 0.2, 0.4), (0.1, 0.1, 2.0)])
def test_points_fill_the_picture(direction, size):
    points = np.random.default_rng(3).random((400, 3)) * size + [5.0, -2.0, 1.0]
    seen = framed(np.array(direction), points).project(points)
    assert (seen[:, 2] > 0).all()
    assert abs(seen[:, :2]).max() < 1.0
    assert max(np.ptp(seen[:, 0]), np.ptp(seen[:, 1])) > 1.6  # of 2


def test_up_stays_up():
    camera = framed(np.array([1.0, 1.0, 1.0]), np.eye(3))
    low, high = camera.project(np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]))
    assert high[1] > low[1]


UNITS = st.tuples(*[st.floats(-1.0, 1.0)] * 3).map(np.array).filter(lambda v: np.dot(v, v) > 0.01)


@settings(max_examples=40)
@given(UNITS, st.integers(0, 2**32 - 1), st.integers(1, 6))
def test_whatever_the_direction_all_points_are_in_the_picture(direction, seed, count):
    points = np.random.default_rng(seed).uniform(-2.0, 2.0, (count, 3))
    camera = framed(direction, points)
    seen = camera.project(points)
    assert (seen[:, 2] > 0.0).all()
    assert abs(seen[:, :2]).max() <= 1.0
    np.testing.assert_allclose(camera.axes @ camera.axes.T, np.eye(3), atol=1e-9)
    assert np.linalg.det(camera.axes) == pytest.approx(-1.0), "right, up and forward"
    assert camera.axes[1, 2] >= 0.0, "up is not down"


def test_a_point_at_the_edge_of_the_view_is_at_one():
    """An eye at the origin that looks along y: the edge is at tan of half the field."""
    camera = Camera(np.zeros(3), np.array([0.0, 1.0, 0.0]))
    edge = np.tan(0.5 * FIELD)
    points = np.array([[0.0, 2.0, 2.0 * edge], [2.0 * edge * ASPECT, 2.0, 0.0], [0.0, 5.0, 0.0]])
    np.testing.assert_allclose(
        camera.project(points), [(0.0, 1.0, 2.0), (1.0, 0.0, 2.0), (0.0, 0.0, 5.0)], atol=1e-12
    )


def test_the_eye_looks_from_the_side_it_is_told():
    points = np.random.default_rng(1).random((50, 3))
    for direction in np.array([(1.0, 0.2, 0.3), (-0.5, 1.0, 0.1), (0.1, -1.0, 2.0)]):
        camera = framed(direction, points)
        unit = direction / np.linalg.norm(direction)
        np.testing.assert_allclose(camera.axes[2], -unit, atol=1e-12)
