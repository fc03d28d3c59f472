"""Activation functions by values of their formulas, and where their pieces meet."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.control.neural.activation import Activation, activation
from dualarm_repro.settings import code


def bipolar(u):
    """As it is printed, by exponentials."""
    return (1 + np.exp(-4)) / (1 - np.exp(-4)) * (1 - np.exp(-4 * u)) / (1 + np.exp(-4 * u))


@pytest.mark.parametrize(
    ("form", "u", "value"),
    [
        (Activation.LINEAR, -2.5, -2.5),
        (Activation.POWER, -2.0, -8.0),
        (Activation.BIPOLAR_SIGMOID, 0.3, bipolar(0.3)),
        (Activation.BIPOLAR_SIGMOID, 2.0, bipolar(2.0)),
        (Activation.POWER_SIGMOID, 0.3, bipolar(0.3)),
        (Activation.POWER_SIGMOID, -2.0, -8.0),
        (Activation.TANH, 0.5, np.tanh(1.5)),
        (Activation.SINH, -0.5, -np.sinh(1.5)),
        (Activation.SIGN_BI_POWER, 4.0, 9.0),
        (Activation.SIGN_BI_POWER, -4.0, -9.0),
        (Activation.SIGN_BI_POWER, 0.0, 0.0),
    ],
)
def test_values_of_the_formulas(form, u, value):
    assert activation(code(form), u) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("form", [Activation.BIPOLAR_SIGMOID, Activation.POWER_SIGMOID])
def test_the_sigmoids_pass_through_one_at_one(form):
    for u in (1.0 - 1e-9, 1.0, 1.0 + 1e-9):
        assert activation(code(form), u) == pytest.approx(1.0, abs=1e-8)


@settings(max_examples=30)
@given(u=st.floats(1.0, 1e3))
def test_far_from_zero_who_is_faster_than_linear(u):
    for form in (Activation.POWER, Activation.POWER_SIGMOID, Activation.SINH):
        assert activation(code(form), u) >= u
    for form in (Activation.BIPOLAR_SIGMOID, Activation.TANH):
        assert activation(code(form), u) <= 1.1


@pytest.mark.parametrize("u", [-1e6, 1e6])
def test_sinh_stays_finite(u):
    assert activation(code(Activation.SINH), u) == pytest.approx(np.sign(u) * np.sinh(50.0))
