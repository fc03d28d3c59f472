import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from dualarm_repro.scene.boxes import (
    closest_parameter,
    excess,
    segment_box,
    segment_box_distance,
    shortest_exit,
)
from examples import lengths, placements, points, thorough

sizes = st.tuples(lengths, lengths, lengths)


def outside(a, u, h, t):
    return np.linalg.norm(excess(tuple(np.array(a) + t * np.array(u)), h))


@given(points, points, sizes)
@thorough
def test_the_nearest_point_is_the_minimum_of_a_convex_function(a, u, h):
    t = closest_parameter(a, u, h)
    assert 0 <= t <= 1
    found = minimize_scalar(lambda t: outside(a, u, h, t), bounds=(0, 1), options={"xatol": 1e-12})
    smallest = min(found.fun, outside(a, u, h, 0), outside(a, u, h, 1))
    assert outside(a, u, h, t) <= smallest + 1e-12


@given(points, points, sizes)
@example((0.0, 0.5, 0.0), (0.0, -1.0, 0.447473), (0.5, 0.25, 0.75))  # edge axis = face normal
@thorough
def test_witness(a, u, h):
    distance, p, q, normal = segment_box(a, u, h)
    assert distance == segment_box_distance(a, u, h)
    assert np.linalg.norm(normal) == pytest.approx(1, abs=1e-12)
    np.testing.assert_allclose(np.add(p, distance * np.array(normal)), q, atol=1e-9)
    assert (np.abs(q) <= np.array(h) + 1e-9).all()
    surface = np.abs(np.abs(q) - h).min()
    assert surface < 1e-9  # on the surface, from outside and from inside


@given(points, points, sizes, placements)
@thorough
def test_no_direction_leads_out_of_the_box_faster(start, u, h, placement):
    a = tuple(np.multiply(start, h))  # starts inside
    m = placement.rotation[:, 0]
    depth, best, _ = shortest_exit(a, u, h)
    ends = np.array([a, np.add(a, u)])
    reach = np.abs(m) @ h
    assert depth <= reach - (ends @ m).min() + 1e-12
    assert depth == pytest.approx(np.abs(best) @ np.array(h) - (ends @ best).min(), abs=1e-12)


def test_the_exit_separates():
    """Moved out by the depth the segment touches, a bit further it is free."""
    rng = np.random.default_rng(0)
    inside = 0
    for _ in range(1000):
        h = tuple(rng.uniform(0.1, 0.5, 3))
        a, u = 0.3 * rng.normal(size=(2, 3))
        distance, _, _, normal = segment_box(tuple(a), tuple(u), h)
        if distance < 0:
            inside += 1
            for extra in (0.0, 1e-3):
                moved = a + (distance - extra) * np.array(normal)
                found = segment_box_distance(tuple(moved), tuple(u), h)
                assert found == pytest.approx(extra, abs=1e-9)
    assert inside > 300


H = (0.5, 0.4, 0.3)


@pytest.mark.parametrize(
    ("a", "u", "distance", "p", "normal"),
    [
        ((-2, 0, 0.5), (4, 0, 0), 0.2, (0, 0, 0.5), (0, 0, -1)),  # above the whole top: its middle
        ((0.25, 0, 0.5), (4, 0, 0), 0.2, (0.375, 0, 0.5), (0, 0, -1)),  # above half of the top
        ((1, 1, 1), (1, 1, 1), np.sqrt(0.25 + 0.36 + 0.49), (1, 1, 1), None),  # corner
        ((0, 0, 0), (0, 0, 0), -0.3, (0, 0, 0), (0, 0, -1)),  # center: the first nearest face
        ((0.4, 0, 0), (0, 0, 0), -0.1, (0.4, 0, 0), (-1, 0, 0)),
        ((-2, 0, 0), (4, 0, 0), -0.3, (0, 0, 0), (0, 0, -1)),  # through: middle of the inner part
        ((0, 0, -9), (0, 0, 18), -0.4, (0, 0, 0), (0, -1, 0)),
        ((0.1, 0.1, 0.3), (0, 0, 2), 0, (0.1, 0.1, 0.3), (0, 0, -1)),  # stands on the top
    ],
)
def test_known_cases(a, u, distance, p, normal):
    found = segment_box(*(tuple(map(float, x)) for x in (a, u, H)))
    assert found[0] == pytest.approx(distance, abs=1e-12)
    np.testing.assert_allclose(found[1], p, atol=1e-12)
    if normal is not None:
        np.testing.assert_allclose(found[3], normal, atol=1e-12)


@pytest.mark.parametrize("place", range(6))
def test_a_segment_at_no_number_is_at_no_distance(place):
    numbers = np.array([0.1, 5.0, 5.0, 0.1, 0.1, 0.1, 0.1, 0.2, 0.3])
    numbers[place] = np.nan
    a, u, h = (tuple(map(float, part)) for part in numbers.reshape(3, 3))
    assert np.isnan(segment_box_distance(a, u, h))
    assert np.isnan(segment_box(a, u, h)[0])


def test_an_edge_pushed_past_an_edge():
    """A long segment across a box edge leaves along the common normal of both edges."""
    a, u = (0.6, 0.2, -1.0), (-0.3, 0.3, 2.0)
    depth, direction, axis = shortest_exit(a, u, (0.5, 0.4, 0.3))
    assert axis >= 3
    assert abs(np.dot(direction, u)) < 1e-12
    distance, p, q, normal = segment_box(a, u, (0.5, 0.4, 0.3))
    assert distance == -depth
    np.testing.assert_allclose(np.add(p, distance * np.array(normal)), q, atol=1e-12)
