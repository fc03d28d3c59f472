"""The pseudo-inverse solution by singular values, against numpy and the Cholesky factor."""

import numpy as np
import pytest

from dualarm_repro.control.least_norm import least_norm
from dualarm_repro.control.singular_values import least_norm_by_singular_values


@pytest.mark.parametrize("shape", [(1, 4), (3, 7), (6, 14), (6, 6)])
def test_it_is_the_pseudo_inverse_solution(shape):
    rng = np.random.default_rng(shape)
    A, b, target = rng.normal(size=shape), rng.normal(size=shape[0]), rng.normal(size=shape[1])
    x, other, multipliers = np.empty(shape[1]), np.empty(shape[1]), np.empty(shape[0])
    least_norm_by_singular_values(target, A, b, x)
    least_norm(target, A, b, other, multipliers)
    np.testing.assert_allclose(x, target + np.linalg.pinv(A) @ (b - A @ target), atol=1e-11)
    np.testing.assert_allclose(x, other, atol=1e-9)


def test_nearly_dependent_rows_lose_less_than_with_the_square_of_the_matrix():
    A = np.array([[1.0, 0.0, 0.0], [1.0, 1e-7, 0.0]])
    b = A @ np.array([1.0, 1.0, 0.0])
    x, other = np.empty(3), np.empty(3)
    least_norm_by_singular_values(np.zeros(3), A, b, x)
    least_norm(np.zeros(3), A, b, other, np.empty(2))
    assert np.abs(x - [1.0, 1.0, 0.0]).max() < 1e-7
    assert np.abs(other - [1.0, 1.0, 0.0]).max() > 1e-7
