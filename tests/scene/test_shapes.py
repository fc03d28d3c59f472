import numpy as np
import pytest
from hypothesis import given

from dualarm_repro.errors import InputError
from dualarm_repro.scene import (
    Box,
    Capsule,
    HalfSpace,
    Sphere,
    facing,
    point_distances,
    window_frame,
)
from examples import placements, shapes, thorough

SQUARE = (np.eye(3), 0.9, 1.1, 0.1, 0.2)


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: Sphere((0, 0, 0), 0), r"Sphere: radius = 0: expected a positive finite number"),
        (lambda: Sphere((0, 0, 0), -1.5), r"Sphere: radius = -1.5"),
        (lambda: Sphere((0, 0, 0), "big"), r"Sphere: radius = 'big'"),
        (lambda: Sphere((0, 0, 0), None), r"Sphere: radius = None"),
        (lambda: Sphere((0, np.nan, 0), 1), r"Sphere: center = \(0, nan, 0\): expected three"),
        (lambda: Sphere((0, 0), 1), r"Sphere: center = \(0, 0\): expected three finite numbers"),
        (lambda: Capsule((0, 0, 0), (0, 0, np.inf), 1), r"Capsule: end"),
        (lambda: Capsule((0, 0, 0), (0, 0, 1), np.nan), r"Capsule: radius = nan"),
        (lambda: Box((0, 0, 0), (1, 0, 1)), r"Box: size\[1\]"),
        (lambda: Box((0, 0, 0), (1, 1, 1), 2 * np.eye(3)), r"Box: rotation.*rotation matrix"),
        (lambda: Box((0, 0, 0), (1, 1, 1), np.diag([1, 1, -1])), r"Box: rotation"),
        (lambda: HalfSpace((0, 0, 0), 1), r"HalfSpace: normal.*not zero"),
        (lambda: HalfSpace((0, 0, 1), np.nan), r"HalfSpace: offset = nan"),
        (lambda: facing((0, 0, 2)), r"facing: up.*not parallel"),
        (lambda: window_frame((0, 0, 0), np.eye(3), 1, 1, 0, 1), r"window_frame: bar_width = 0"),
        (lambda: window_frame((0, 0, 0), np.eye(3), -1, 1, 1, 1), r"opening_width = -1"),
        (lambda: window_frame((0, 0, 0), np.ones((3, 3)), 1, 1, 1, 1), r"rotation"),
    ],
)
def test_bad_input(build, message):
    with pytest.raises(InputError, match=message) as caught:
        build()
    assert "\n" not in str(caught.value)


def test_shapes_do_not_change_with_their_input():
    center = np.zeros(3)
    sphere = Sphere(center, 1)
    center[0] = 5
    assert sphere.center[0] == 0
    with pytest.raises(ValueError, match="read-only"):
        sphere.center[0] = 5


@given(shapes, placements)
@thorough
def test_moving_there_and_back(shape, placement):
    back = shape.moved(placement).moved(placement.inverse())
    probe = np.random.default_rng(0).normal(size=(20, 3))
    found, expected = (point_distances(probe, [s])[0] for s in (back, shape))
    np.testing.assert_allclose(found, expected, atol=1e-9)


@given(placements)
@thorough
def test_facing_is_a_rotation_with_the_normal_last(placement):
    normal, up = placement.rotation[:, 0], placement.rotation[:, 1] + placement.rotation[:, 0]
    R = facing(3 * normal, up)
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(R) == pytest.approx(1)
    np.testing.assert_allclose(R[:, 2], normal, atol=1e-12)
    np.testing.assert_allclose(R[:, 1], placement.rotation[:, 1], atol=1e-12)


def test_facing_x_has_height_z():
    np.testing.assert_allclose(facing((1, 0, 0)), [[0, 0, 1], [1, 0, 0], [0, 1, 0]])


def test_window_leaves_exactly_its_opening():
    """Opening 0.9 x 1.1, bars 0.1 wide and 0.2 deep: sampled points are inside a bar or not."""
    center, R = np.array([0.1, 0.2, 0.3]), facing((1, 1, 0))
    bars = window_frame(center, R, 0.9, 1.1, 0.1, 0.2)
    rng = np.random.default_rng(0)
    local = rng.uniform(-1, 1, (4000, 3)) * (0.8, 0.8, 0.15)
    inside = (point_distances(center + local @ R.T, bars)[0] < 0).sum(axis=1)
    x, y, z = np.abs(local).T
    outer = (x < 0.55) & (y < 0.65) & (z < 0.1)
    opening = (x < 0.45) & (y < 0.55)
    np.testing.assert_array_equal(inside, outer & ~opening)  # once each: bars do not overlap


def test_window_order_is_top_bottom_left_right():
    top, bottom, left, right = window_frame((0, 0, 0), *SQUARE)
    np.testing.assert_allclose(top.center, (0, 0.6, 0))
    np.testing.assert_allclose(bottom.center, (0, -0.6, 0))
    np.testing.assert_allclose(left.center, (-0.5, 0, 0))
    np.testing.assert_allclose(right.center, (0.5, 0, 0))
