"""Central differences: exact for quadratics, of second order otherwise, for values of any shape."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from dualarm_repro.differences import central_differences

VECTORS = arrays(float, 4, elements=st.floats(-2.0, 2.0))


@given(VECTORS, arrays(float, (4, 4), elements=st.floats(-2.0, 2.0)))
def test_exact_for_a_quadratic(x, a):
    found = central_differences(lambda at: at @ a @ at, x, step=1e-3)
    np.testing.assert_allclose(found, (a + a.T) @ x, atol=1e-9)


@given(VECTORS)
def test_rows_are_the_directions_whatever_the_shape_of_the_value(x):
    found = central_differences(lambda at: np.outer(at, [1.0, 2.0]), x)
    assert found.shape == (4, 4, 2)
    np.testing.assert_allclose(found, np.multiply.outer(np.eye(4), [1.0, 2.0]), atol=1e-8)


def test_error_falls_with_the_square_of_the_step():
    errors = [abs(central_differences(np.exp, [0.3], h)[0, 0] - np.exp(0.3)) for h in (1e-2, 5e-3)]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=1e-3)
