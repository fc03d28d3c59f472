"""Cholesky factors and triangular systems in place, against numpy and scipy."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import solve_triangular

from dualarm_repro.control.neural.saddle import (
    backward,
    factorise,
    forward,
    solve_multipliers,
    solve_saddle,
)


def positive_definite(n, seed):
    B = np.random.default_rng(seed).normal(size=(n, n + 2))
    return B @ B.T


@settings(max_examples=30)
@given(n=st.integers(1, 12), seed=st.integers(0, 10**6))
def test_factor_and_triangular_solves_equal_the_library(n, seed):
    M = positive_definite(n, seed)
    factor = M.copy()
    factorise(factor)
    L = np.linalg.cholesky(M)
    np.testing.assert_allclose(np.tril(factor), L, rtol=1e-9, atol=1e-12)
    v = np.random.default_rng(seed + 1).normal(size=n)
    down, up = v.copy(), v.copy()
    forward(factor, down)
    backward(factor, up)
    np.testing.assert_allclose(down, solve_triangular(L, v, lower=True), rtol=1e-8, atol=1e-10)
    np.testing.assert_allclose(up, solve_triangular(L.T, v), rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize("wrong", [[[1.0, 2.0], [2.0, 1.0]], [[-1.0, 0.0], [0.0, 1.0]]])
def test_a_matrix_that_is_not_positive_definite_shows_as_nan(wrong):
    M = np.array(wrong)
    factorise(M)
    assert np.isnan(np.diag(M)).any()


def test_multipliers_by_hand():
    # One row (3, 4): 25 l = 3 * 1 + 4 * 2 - 1.
    found = np.array([1.0])
    solve_multipliers(np.array([[3.0, 4.0]]), np.array([1.0, 2.0]), found)
    assert found == pytest.approx([0.4])


def test_a_saddle_system_by_hand():
    """min x^2 + y^2 - 2 x s.t. x + y = 3: (2, 1) with the multiplier -2."""
    f = np.array([2.0, 0.0, 3.0])
    solve_saddle(2.0 * np.eye(2), np.array([[1.0, 1.0]]), f)
    np.testing.assert_allclose(f, [2.0, 1.0, -2.0], atol=1e-12)


def test_without_equalities_a_saddle_system_is_that_of_the_hessian():
    H, f = positive_definite(5, 3), np.arange(5.0)
    expected = np.linalg.solve(H, f)
    solve_saddle(H, np.empty((0, 5)), f)
    np.testing.assert_allclose(f, expected, rtol=1e-9)
