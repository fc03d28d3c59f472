"""Penalties by values worked out by hand, their order among each other and far out."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.control.neural.penalty import Penalty, penalty
from dualarm_repro.settings import code

QUADRATIC, SOFTPLUS, SQUARED, EXPONENTIAL = map(code, Penalty)
LN2 = np.log(2.0)


@pytest.mark.parametrize(
    ("kind", "g", "expected"),
    [
        (QUADRATIC, 0.5, (0.375, 1.5, 3.0)),
        (QUADRATIC, -0.5, (0.0, 0.0, 0.0)),
        # With p = 3 and s = 2: p/s ln 2, p/2, p s/4.
        (SOFTPLUS, 0.0, (1.5 * LN2, 1.5, 1.5)),
        (SQUARED, 0.0, (1.5 * (LN2 / 2) ** 2, 3 * LN2 / 4, 3 * (0.25 + LN2 / 2 * 0.5))),
        (EXPONENTIAL, 0.5, (3 * np.e, 6 * np.e, 12 * np.e)),
        (EXPONENTIAL, -0.5, (3 / np.e, 6 / np.e, 12 / np.e)),
    ],
)
def test_values_of_the_formulas(kind, g, expected):
    np.testing.assert_allclose(penalty(kind, 3.0, 2.0, g), expected, rtol=1e-12)


@settings(max_examples=40)
@given(g=st.floats(-3.0, 3.0), s=st.floats(0.5, 50.0))
def test_soft_forms_lie_above_what_they_tend_to_by_at_most_their_value_at_zero(g, s):
    sharp, soft = max(g, 0.0), penalty(SOFTPLUS, 1.0, s, g)[0]
    assert -1e-12 <= soft - sharp <= LN2 / s + 1e-12
    assert penalty(SQUARED, 1.0, s, g)[0] == pytest.approx(0.5 * soft**2, rel=1e-12)
    # P'(g) + P'(-g) = p of the softplus: its slope is a sigmoid.
    slopes = penalty(SOFTPLUS, 1.0, s, g)[1] + penalty(SOFTPLUS, 1.0, s, -g)[1]
    assert slopes == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize("kind", range(len(Penalty)))
@settings(max_examples=20)
@given(g=st.floats(-2.0, 2.0), apart=st.floats(0.0, 2.0), factor=st.floats(0.1, 10.0))
def test_each_is_convex_increasing_and_linear_in_its_factor(kind, g, apart, factor):
    here, there = (penalty(kind, 1.0, 4.0, v) for v in (g, g + apart))
    assert there[0] >= here[0]
    assert there[1] >= here[1] - 1e-12
    np.testing.assert_allclose(penalty(kind, factor, 4.0, g), factor * np.array(here), rtol=1e-12)


def test_the_exponential_goes_on_as_the_parabola_that_touches_it():
    s, edge = 10.0, 6.0
    inside, beyond = (penalty(EXPONENTIAL, 2.0, s, edge + side * 1e-9) for side in (-1, 1))
    np.testing.assert_allclose(beyond, inside, rtol=1e-7)
    value = 2.0 * np.exp(60.0)
    found = penalty(EXPONENTIAL, 2.0, s, edge + 0.3)
    np.testing.assert_allclose(found, value * np.array([1 + 3 + 4.5, s * 4, s * s]), rtol=1e-9)
