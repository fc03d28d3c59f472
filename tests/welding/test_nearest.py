"""The smallest distance over a path, against all pairs of all rows one by one."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from dualarm_repro.welding.nearest import smallest_distances

CAPSULES = 5
PAIRS = np.array([[0, 2], [0, 3], [1, 2], [1, 4], [3, 4]])
NONE = np.empty(0, np.int64)


def segment_distance(first, second):
    """Distance of two segments by bounded least squares in their two parameters."""
    a, u, b, v = first[0], first[1] - first[0], second[0], second[1] - second[0]
    found = lsq_linear(np.column_stack([u, -v]), b - a, (0, 1), method="bvls", tol=1e-14)
    return float(np.linalg.norm(found.fun))


def drawn(seed, rows, spread):
    rng = np.random.default_rng(seed)
    middle = spread * rng.normal(size=(rows, CAPSULES, 1, 3))
    # A capsule is as long in every row: it only turns and moves.
    half = rng.uniform(0.05, 0.5, (1, CAPSULES, 1))
    way = rng.normal(size=(rows, CAPSULES, 3))
    way *= half / np.linalg.norm(way, axis=2, keepdims=True)
    ends = middle + np.stack([-way, way], axis=2)
    return ends, rng.uniform(0.01, 0.2, CAPSULES)


def by_hand(ends, radius, above, height):
    least = np.inf
    for row in ends:
        for i, j in PAIRS:
            least = min(least, segment_distance(row[i], row[j]) - radius[i] - radius[j])
        for c in above:
            least = min(least, row[c, :, 2].min() - height - radius[c])
    return least


@settings(max_examples=25)
@given(seed=st.integers(0, 10**6), spread=st.sampled_from([0.2, 1.0, 3.0]))
def test_leaving_out_far_pairs_changes_nothing(seed, spread):
    ends, radius = drawn(seed, 6, spread)
    for above in (NONE, np.array([1, 4])):
        found = smallest_distances(ends, radius, PAIRS, above, -1.0, 3)
        expected = [by_hand(part, radius, above, -1.0) for part in (ends[:3], ends[3:])]
        np.testing.assert_allclose(found, expected, atol=1e-7)


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6), by=st.floats(0.001, 0.2))
def test_thicker_capsules_and_more_pairs_are_nearer(seed, by):
    ends, radius = drawn(seed, 4, 1.0)
    plain = smallest_distances(ends, radius, PAIRS, NONE, 0.0, 4)[0]
    thick = smallest_distances(ends, radius + by, PAIRS, NONE, 0.0, 4)[0]
    assert thick == pytest.approx(plain - 2 * by, abs=1e-9)
    assert smallest_distances(ends, radius, PAIRS[:3], NONE, 0.0, 4)[0] >= plain - 1e-12
    turned = smallest_distances(ends, radius, PAIRS[:, ::-1].copy(), NONE, 0.0, 4)[0]
    assert turned == pytest.approx(plain, abs=1e-12)
    reversed_ends = np.ascontiguousarray(ends[:, :, ::-1])
    assert smallest_distances(reversed_ends, radius, PAIRS, NONE, 0.0, 4)[0] == pytest.approx(plain)


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6), shift=st.floats(0.0, 0.5))
def test_a_distance_changes_by_no_more_than_its_body_moves(seed, shift):
    ends, radius = drawn(seed, 1, 0.7)
    moved, way = ends.copy(), np.random.default_rng(seed).normal(size=3)
    moved[:, 0] += shift * way / np.linalg.norm(way)
    plain, other = (
        smallest_distances(e, radius, PAIRS[:1], NONE, 0.0, 1)[0] for e in (ends, moved)
    )
    assert abs(other - plain) <= shift + 1e-9


def test_without_pairs_nothing_is_near():
    ends, radius = drawn(0, 2, 1.0)
    assert smallest_distances(ends, radius, PAIRS[:0], NONE, 0.0, 2)[0] == np.inf


def test_the_floor_alone_by_hand():
    ends = np.zeros((2, CAPSULES, 2, 3))
    ends[:, :, :, 2] = [[0.5, 0.7]] * CAPSULES
    ends[1, 2, 1, 2] = 0.4
    radius = np.full(CAPSULES, 0.1)
    assert smallest_distances(ends, radius, PAIRS[:0], np.array([2]), 0.2, 2)[0] == pytest.approx(
        0.1
    )
    assert smallest_distances(ends, radius, PAIRS[:0], np.array([1]), 0.2, 2)[0] == pytest.approx(
        0.2
    )
