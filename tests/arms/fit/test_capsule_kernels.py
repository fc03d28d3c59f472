"""The smallest capsules along directions: they hold every point, and cuts keep area and side."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arms.capsules import to_segment
from dualarm_repro.arms.fit.capsule_kernels import along, covered, cut, refined, smallest


def points_of(seed, count=30, spread=(0.05, 0.1, 0.4)):
    return np.random.default_rng(seed).normal(size=(count, 3)) * spread


def direction(seed):
    u = np.random.default_rng(seed).normal(size=3)
    return u / np.linalg.norm(u)


def volume_of(capsule):
    length, R = np.linalg.norm(capsule[3:6] - capsule[:3]), capsule[6]
    return np.pi * R**2 * length + 4 / 3 * np.pi * R**3


@settings(max_examples=40)
@given(seed=st.integers(0, 10**6))
def test_a_capsule_holds_its_points_along_its_direction_and_has_the_volume_told(seed):
    points, u, found = points_of(seed), direction(seed), np.empty(7)
    volume = along(points, u, found)
    gaps = to_segment(points, found[:3], found[3:6]) - found[6]
    assert gaps.max() <= 1e-9
    axis = found[3:6] - found[:3]
    if axis.any():  # else the ends would cross, and a ball in the middle holds all
        assert gaps.max() >= -1e-9, "a point lies on it"
    np.testing.assert_allclose(np.cross(axis, u), 0.0, atol=1e-12)
    assert axis @ u >= -1e-12
    assert volume == pytest.approx(volume_of(found))


def test_points_on_a_line_and_one_point_by_hand():
    found = np.empty(7)
    line = np.array([[0.0, 0, 0], [0, 0, 0.3], [0, 0, 1.0]])
    along(line, np.array([0, 0, 1.0]), found)
    np.testing.assert_allclose(found, [0, 0, 0, 0, 0, 1, 0], atol=1e-12)
    along(line[1:2], np.array([1.0, 0, 0]), found)
    np.testing.assert_allclose(found, [0, 0, 0.3, 0, 0, 0.3, 0], atol=1e-12)


def test_a_square_seen_from_above_by_hand():
    square = np.array([[x, y, 0.0] for x in (-1, 1) for y in (-1, 1)])
    found = np.empty(7)
    along(square, np.array([0, 0, 1.0]), found)
    # The radius of its circle, and a length of zero.
    np.testing.assert_allclose(found[6], np.sqrt(2.0), rtol=1e-12)
    np.testing.assert_allclose(found[:6], 0.0, atol=1e-12)


@pytest.mark.parametrize("turned", np.arange(4) * np.pi / 2)
def test_the_circle_of_a_prism_is_found_where_the_middle_of_its_extent_is_not_its_centre(turned):
    corners = turned + np.array([0.0, 2.0, 4.0]) * np.pi / 3
    prism = np.array([[np.cos(a), np.sin(a), z] for a in corners for z in (0.0, 30.0)])
    found = np.empty(7)
    along(prism, np.array([0, 0, 1.0]), found)
    # The middle of the extent would need a radius of 1.146; n steps end within 1 / n.
    assert 1.0 - 1e-12 <= found[6] < 1.04


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6))
def test_more_directions_and_refinement_never_make_it_larger(seed):
    points, found = points_of(seed), np.empty(7)
    directions = np.array([direction(seed + k) for k in range(6)])
    few = smallest(points, directions[:3], found)
    many = smallest(points, directions, found)
    assert many <= few
    assert many == pytest.approx(min(along(points, u, np.empty(7)) for u in directions))
    assert many == pytest.approx(volume_of(found))
    better = refined(points, directions, 12, found)
    assert better <= many + 1e-12
    assert (to_segment(points, found[:3], found[3:6]) <= found[6] + 1e-9).all()


def test_refinement_finds_the_axis_of_a_long_body():
    points = points_of(4, 200, (0.01, 0.01, 1.0))
    found, start = np.empty(7), np.array([[np.sin(0.5), 0.0, np.cos(0.5)]])
    refined(points, start, 60, found)
    axis = found[3:6] - found[:3]
    # within a few degrees: the ends of the cloud are ragged
    assert abs(axis[2]) / np.linalg.norm(axis) == pytest.approx(1.0, abs=2e-3)


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6))
def test_covered_points_are_those_within_the_radius_and_stay_marked(seed):
    points, rng = points_of(seed), np.random.default_rng(seed)
    capsule = np.concatenate([rng.normal(size=6) * 0.2, [0.15]])
    inside = np.zeros(len(points), bool)
    inside[0] = True
    covered(points, capsule, inside)
    expected = to_segment(points, capsule[:3], capsule[3:6]) <= 0.15
    expected[0] = True
    np.testing.assert_array_equal(inside, expected)
    ball = np.array([0, 0, 0, 0, 0, 0, 0.2])
    inside[:] = False
    covered(points, ball, inside)
    np.testing.assert_array_equal(inside, np.linalg.norm(points, axis=1) <= 0.2)


def area(triangles):
    crossed = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return 0.5 * np.linalg.norm(crossed, axis=1).sum()


@settings(max_examples=40)
@given(seed=st.integers(0, 10**6), offset=st.floats(-1.0, 1.0))
def test_a_cut_keeps_the_area_and_puts_every_part_on_its_side(seed, offset):
    triangles = np.random.default_rng(seed).normal(size=(12, 3, 3))
    normal = direction(seed)
    below, above = cut(triangles, normal, offset)
    assert area(below) + area(above) == pytest.approx(area(triangles))
    assert (below @ normal).max(initial=-np.inf) <= offset + 1e-9
    assert (above @ normal).min(initial=np.inf) >= offset - 1e-9
    # Halves of the mirrored cut are the same, swapped.
    other, first = cut(triangles, -normal, -offset)
    assert area(first) == pytest.approx(area(below))
    assert area(other) == pytest.approx(area(above))


def test_a_triangle_cut_in_half_by_hand():
    triangle = np.array([[[0.0, 0, 0], [2, 0, 0], [0, 2, 0]]])
    below, above = cut(triangle, np.array([1.0, 0, 0]), 1.0)
    assert (area(below), area(above)) == pytest.approx((1.5, 0.5))
    assert (len(below), len(above)) == (2, 1)
    whole, none = cut(triangle, np.array([1.0, 0, 0]), 2.0)
    assert (len(whole), len(none)) == (1, 0)


def test_a_corner_on_the_plane_belongs_to_both_parts():
    triangle = np.array([[[1.0, 0, 0], [-1, 0, 0], [0, 1, 0]]])
    below, above = cut(triangle, np.array([1.0, 0, 0]), 0.0)
    assert (len(below), len(above)) == (1, 1)
    assert (area(below), area(above)) == pytest.approx((0.5, 0.5))
