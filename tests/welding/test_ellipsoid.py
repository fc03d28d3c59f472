"""Volumes of velocity ellipsoids, by known bodies and by how they scale and turn."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arms import load_arm
from dualarm_repro.welding.ellipsoid import (
    coupled_pair_volume,
    ellipsoid_volume,
    gram_matrices,
    intersection_volume,
    unit_ball_volume,
)


def ellipsoids(count, seed, size=3):
    J = np.random.default_rng(seed).normal(size=(count, size, size + 3))
    return J @ J.transpose(0, 2, 1)


@pytest.mark.parametrize(
    ("dimension", "volume"),
    [(1, 2.0), (2, np.pi), (3, 4 * np.pi / 3), (4, np.pi**2 / 2), (6, np.pi**3 / 6)],
)
def test_unit_balls(dimension, volume):
    assert unit_ball_volume(dimension) == pytest.approx(volume)


def test_an_ellipsoid_along_the_axes_has_the_product_of_its_half_axes():
    halves = np.array([0.5, 2.0, 3.0])
    assert ellipsoid_volume(np.diag(halves**2)) == pytest.approx(4 * np.pi / 3 * 3.0)
    flat = np.diag([1.0, 1.0, 0.0])
    assert ellipsoid_volume(np.stack([flat, flat - 1e-18])).tolist() == [0.0, 0.0]


@settings(max_examples=20)
@given(seed=st.integers(0, 1000), scale=st.floats(0.1, 10.0))
def test_volumes_do_not_turn_and_scale_with_the_cube_of_velocities(seed, scale):
    A, B = ellipsoids(2, seed)
    R = pin.exp3(np.random.default_rng(seed).normal(size=3))
    turned, other = R @ A @ R.T, R @ B @ R.T
    assert ellipsoid_volume(turned) == pytest.approx(ellipsoid_volume(A))
    assert coupled_pair_volume(turned, other) == pytest.approx(coupled_pair_volume(A, B))
    assert ellipsoid_volume(scale**2 * A) == pytest.approx(scale**3 * ellipsoid_volume(A))
    larger = coupled_pair_volume(scale**2 * A, scale**2 * B)
    assert larger == pytest.approx(scale**3 * coupled_pair_volume(A, B))
    assert coupled_pair_volume(A, B) == pytest.approx(coupled_pair_volume(B, A))


def test_a_pair_of_equal_arms_has_the_ellipsoid_that_is_smaller_by_the_root_of_two():
    (A,) = ellipsoids(1, 5)
    assert coupled_pair_volume(A, A) == pytest.approx(ellipsoid_volume(A) / 2**1.5)


def test_two_crossed_slabs_meet_in_a_known_body():
    """Long cylinders of radius 1 along x and y: Steinmetz' solid, 16/3."""
    long = 1e4
    cylinders = np.stack([np.diag([long, 1.0, 1.0]), np.diag([1.0, long, 1.0])])
    assert intersection_volume(cylinders) == pytest.approx(16 / 3, rel=1e-3)


@settings(max_examples=15)
@given(seed=st.integers(0, 1000))
def test_more_ellipsoids_leave_less_in_common_whatever_their_order(seed):
    A = ellipsoids(3, seed)
    whole = intersection_volume(A, 4000)
    assert whole <= intersection_volume(A[:2], 4000) + 1e-12
    assert intersection_volume(A[[2, 0, 1]], 4000) == pytest.approx(whole, rel=1e-12)
    assert intersection_volume(4.0 * A, 4000) == pytest.approx(8.0 * whole, rel=1e-9)


@pytest.mark.parametrize("seed", range(3))
def test_the_gram_matrix_of_a_point_does_not_depend_on_the_frame_that_names_it(seed):
    """v is that of one point of the hand: the base turned, A turns; a lever of zero, the flange."""
    arm, rng = load_arm("kr16-2"), np.random.default_rng(seed)
    q, lever = arm.random_configurations(5, rng), rng.normal(size=(5, 3))
    R = pin.exp3(rng.normal(size=3))
    plain = gram_matrices(arm.chain, np.eye(3), q, lever, 3)
    turned = gram_matrices(arm.chain, R, q, np.ascontiguousarray(lever @ R.T), 3)
    np.testing.assert_allclose(turned, R @ plain @ R.T, atol=1e-12)
    J = arm.jacobian(q)
    flange = gram_matrices(arm.chain, np.eye(3), q, np.zeros((5, 3)), 6)
    np.testing.assert_allclose(flange, J @ J.transpose(0, 2, 1), atol=1e-12)
    np.testing.assert_allclose(plain, plain.transpose(0, 2, 1), atol=0)
    assert (np.linalg.eigvalsh(plain) > -1e-12).all()
