"""Printed formulas: parsed, evaluated, refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.errors import DataFileError
from dualarm_repro.ledger.formula import parse

ONES = np.ones(3)


@given(st.floats(0.1, 10.0), st.floats(0.1, 10.0))
def test_cases_and_norms(d, gain):
    repulsion = parse("U = k/2*(1/d - 1/d_0)^2 if d <= d_0, 0 if d > d_0")
    expected = gain / 2 * (1 / d - 1 / 2.0) ** 2 if d <= 2.0 else 0.0
    assert repulsion.value(1, {"k": gain, "d": d, "d_0": 2.0}) == pytest.approx(expected)
    attraction = parse("U_att = k_a/2*|X - X_g|^2")
    given_values = {"k_a": gain, "X": d * ONES, "X_g": 0 * ONES}
    assert attraction.value(1, given_values) == pytest.approx(1.5 * gain * d * d)


def test_matrices_keep_their_order():
    rng = np.random.default_rng(0)
    j, r, p = rng.normal(size=(3, 5)), rng.normal(size=(3, 3)), rng.normal(size=3)
    assert parse("w = sqrt(det(J(q)*J^T(q)))").value(1, {"J": j}) == pytest.approx(
        np.sqrt(np.linalg.det(j @ j.T))
    )
    assert parse("R*p - p = 0").value(0, {"R": r, "p": p}) == pytest.approx(r @ p - p)
    column = rng.normal(size=(3, 1))
    form = parse("x^T*(J*J^T)^-1*x = 1").value(0, {"x": column, "J": j})
    assert form == pytest.approx(column.T @ np.linalg.inv(j @ j.T) @ column)
    product = parse("T = A*B").value(1, {"A": r, "B": j})
    assert product == pytest.approx(r @ j)


def test_numbered_sum():
    formula = parse("U = k/2*(|X|^2 + sum_{i=1}^{6} |theta_i - theta_{gi}|^2)")
    values = {"k": 2.0, "X": ONES, "theta_i": np.arange(6.0), "theta_gi": np.zeros(6)}
    assert formula.value(1, values) == pytest.approx(3 + 55)
    assert parse("U = sum_{i=1}^{3} u_i").value(1, {"u_i": [1.0, 2.0, 4.0]}) == pytest.approx(7.0)


def test_gradient_is_a_function_that_is_given():
    formula = parse("F = -grad(U) = -k*X")
    assert formula.value(1, {"U": 3.0, "grad": lambda u: 2 * u}) == -6.0
    assert len(formula.sides) == 3


def test_a_changed_coefficient_changes_the_value():
    values = {"k": 1.0, "d": 0.5}
    assert parse("k/2*d").value(0, values) != parse("k/3*d").value(0, values)


@pytest.mark.parametrize("text", ["1 +", "|X", "a in R^(", "x if y", "= =", ")("])
def test_refused(text):
    with pytest.raises(DataFileError, match="a formula"):
        parse(text)


def test_names_that_are_not_given():
    with pytest.raises(DataFileError, match="a name given for"):
        parse("a*b").value(0, {"a": 1.0})
    with pytest.raises(DataFileError, match="one given for"):
        parse("grad(a)").value(0, {"a": 1.0})
    assert parse("a*b + c").symbols() == {"a", "b", "c"}
