"""Directions by the golden angle: of unit length, evenly spread, each turned by the same angle."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from dualarm_repro.welding.ellipsoid import sphere_points

GOLDEN = np.pi * (1.0 + 5.0**0.5)


@pytest.mark.parametrize("count", [10, 1000])
def test_heights_are_even_and_turns_golden(count):
    u = sphere_points(count)
    np.testing.assert_allclose(np.linalg.norm(u, axis=1), 1.0, atol=1e-14)
    np.testing.assert_allclose(np.diff(u[:, 2]), -2.0 / count, atol=1e-14)
    turns = np.diff(np.unwrap(np.arctan2(u[:, 1], u[:, 0]))) % (2.0 * np.pi)
    np.testing.assert_allclose(turns, GOLDEN % (2.0 * np.pi), atol=1e-9)


def test_no_direction_is_crowded_or_left_out():
    u = sphere_points(2000)
    even = np.sqrt(4.0 * np.pi / len(u))
    nearest = cKDTree(u).query(u, k=2)[0][:, 1]
    assert nearest.min() > 0.5 * even
    v = np.random.default_rng(7).normal(size=(500, 3))
    assert cKDTree(u).query(v / np.linalg.norm(v, axis=1)[:, None])[0].max() < even
    np.testing.assert_allclose(u.T @ u / len(u), np.eye(3) / 3.0, atol=1e-3)
