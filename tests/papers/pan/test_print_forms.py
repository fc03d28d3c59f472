"""Printed equations as numbers: residuals, blocks and relations against sums done by hand."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.errors import DataFileError
from dualarm_repro.papers.pan.print_forms import (
    block_matrix,
    block_residual,
    holds,
    in_symbols,
    printed_text,
    residual,
    value,
    worst,
)

INFINITE = float("inf")
A, B = np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[0.0, 1.0], [5.0, 2.0]])


@pytest.mark.parametrize(
    ("text", "names", "expected"),
    [
        ("a = 2*b", {"a": 5.0, "b": 2.0}, 1.0),
        ("a = 2*b", {"a": 4.0, "b": 2.0}, 0.0),
        ("a = 2*b", {"a": -4.0, "b": 2.0}, 8.0),
        # of three sides, the two others are compared with the first
        ("a = b = c", {"a": 1.0, "b": 1.5, "c": 3.0}, 2.0),
        ("a = b = c", {"a": 1.0, "b": 4.0, "c": 3.0}, 3.0),
        # the largest entry counts, not their sum
        ("v = w", {"v": np.array([1.0, 2.0]), "w": np.array([1.5, 1.0])}, 1.0),
        # a product of matrices keeps its order: A B - A B has none, B A another
        ("C = A*B", {"A": A, "B": B, "C": A @ B}, 0.0),
        ("C = A*B", {"A": A, "B": B, "C": B @ A}, float(abs(A @ B - B @ A).max())),
        # a column on one side is the vector on the other
        ("c = v", {"c": np.array([[1.0], [2.0]]), "v": np.array([1.0, 2.5])}, 0.5),
        ("s = |v|", {"s": 4.0, "v": np.array([3.0, 4.0])}, 1.0),
        ("d = det(A)", {"d": -2.0, "A": A}, 0.0),
    ],
)
def test_residual_is_the_largest_gap_between_the_sides(text, names, expected):
    assert residual(text, names) == pytest.approx(expected, abs=1e-14)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("a = 2*c", {"a": 1.0}),  # a name that is not given
        ("a = (b", {"a": 1.0, "b": 1.0}),  # no formula
        ("a", {"a": 1.0}),  # nothing to compare with
        ("a = b", {"a": float("nan"), "b": 1.0}),
        ("a = b", {"a": float("inf"), "b": 1.0}),
        ("u = A*v", {"u": np.ones(2), "A": A, "v": np.ones(3)}),  # sizes that do not fit
        ("B = A^-1", {"A": np.ones((2, 2)), "B": A}),  # singular
    ],
)
def test_a_formula_without_a_value_is_infinitely_wrong(text, names):
    assert residual(text, names) == INFINITE


def test_functions_are_those_that_are_given():
    given_names = {"y": 9.0, "x": 3.0, "square": lambda v: v**2}
    assert residual("y = square(x)", given_names) == 0.0
    assert residual("y = square(x)", {**given_names, "square": lambda v: v}) == 6.0


def test_the_worst_of_several_cases():
    cases = [{"a": 2.0 * k + gap, "b": float(k)} for k, gap in ((1, 0.0), (2, -3.0), (3, 1.0))]
    assert worst("a = 2*b", cases) == 3.0
    assert worst("a = 2*b", [*cases, {"a": 1.0}]) == INFINITE
    assert worst("a = 2*b", []) == INFINITE


@settings(max_examples=30)
@given(
    st.lists(st.floats(-10, 10), min_size=3, max_size=3),
    st.floats(0.1, 5.0),
    st.floats(-4, 4),
)
def test_residual_scales_with_both_sides(entries, factor, gap):
    v = np.array(entries)
    found = residual("a = b", {"a": v, "b": v + gap})
    scaled = residual("a = b", {"a": factor * v, "b": factor * (v + gap)})
    assert scaled == pytest.approx(factor * found, rel=1e-9, abs=1e-12)
    assert residual("a = b", {"a": v + gap, "b": v}) == found


@pytest.mark.parametrize(
    ("text", "names", "expected"),
    [
        ("a + 2*b", {"a": 1.0, "b": 3.0}, 7.0),
        ("m + n", {"m": 6, "n": 7}, 13),
        ("2*m", {"m": 5}, 10),
        ("sqrt(det(A*A^T))", {"A": A}, 2.0),  # |det A| = |4 - 6|
        ("|v|^2", {"v": np.array([1.0, -2.0, 2.0])}, 9.0),
    ],
)
def test_values_of_printed_expressions(text, names, expected):
    assert value(text, names) == pytest.approx(expected, rel=1e-12)


def test_a_value_needs_every_name():
    with pytest.raises(DataFileError, match="b"):
        value("a + b", {"a": 1.0})


class TestBlocks:
    """[[A, 0], [0, B]] and the like, against numpy.block with explicit zeros."""

    def test_zeros_take_the_size_of_row_and_column(self):
        wide, tall = np.arange(6.0).reshape(2, 3), np.arange(4.0).reshape(4, 1) + 1
        found = block_matrix([["J_1", "0"], ["0", "J_2"]], {"J_1": wide, "J_2": tall})
        expected = np.zeros((6, 4))
        expected[:2, :3], expected[2:, 3:] = wide, tall
        np.testing.assert_array_equal(found, expected)

    def test_one_stands_for_the_number_and_a_vector_for_a_column(self):
        R, p = np.diag([1.0, -1.0, -1.0]), np.array([0.1, 0.2, 0.3])
        found = block_matrix([["R", "p"], ["0", "1"]], {"R": R, "p": p})
        np.testing.assert_array_equal(found[:3, :3], R)
        np.testing.assert_array_equal(found[:, 3], [0.1, 0.2, 0.3, 1.0])
        np.testing.assert_array_equal(found[3], [0.0, 0.0, 0.0, 1.0])

    def test_products_of_blocks_are_blocks(self):
        found = block_matrix([["A*B", "0"], ["0", "2*A"]], {"A": A, "B": B})
        np.testing.assert_array_equal(found[:2, :2], A @ B)
        np.testing.assert_array_equal(found[2:, 2:], 2 * A)

    def test_a_block_of_zeros_that_is_given_keeps_its_size(self):
        found = block_matrix([["Z", "p"]], {"Z": np.zeros((2, 2)), "p": np.ones(2)})
        assert found.shape == (2, 3)

    def test_blocks_of_other_heights_are_refused(self):
        with pytest.raises(DataFileError, match="blocks that fit"):
            block_matrix([["A", "p"]], {"A": A, "p": np.ones(3)})

    def test_residual(self):
        rows, names = [["R", "p"], ["0", "1"]], {"R": np.eye(3), "p": np.array([1.0, 2.0, 3.0])}
        pose = np.eye(4)
        pose[:3, 3] = [1.0, 2.0, 3.25]
        assert block_residual(rows, names, pose) == 0.25
        pose[2, 3] = 3.0
        assert block_residual(rows, names, pose) == 0.0
        pose[3, 3] = 2.0
        assert block_residual(rows, names, pose) == 1.0

    @pytest.mark.parametrize("rows", [[["R", "p"]], [["R", "missing"], ["0", "1"]], [["R"]]])
    def test_a_matrix_of_another_size_or_without_a_value_never_fits(self, rows):
        names = {"R": np.eye(3), "p": np.ones(3)}
        assert block_residual(rows, names, np.eye(4)) == INFINITE


@pytest.mark.parametrize(
    ("text", "names", "true"),
    [
        ("a < b", {"a": 1.0, "b": 2.0}, True),
        ("a < b", {"a": 2.0, "b": 2.0}, False),
        ("a <= b", {"a": 2.0, "b": 2.0}, True),
        ("a > b", {"a": 2.0, "b": 2.0}, False),
        ("a >= b", {"a": 2.0, "b": 2.0}, True),
        ("a >= b", {"a": 1.9, "b": 2.0}, False),
        ("a = b", {"a": 0.1 + 0.2, "b": 0.3}, True),
        ("a = b", {"a": 0.3001, "b": 0.3}, False),
        # a chain holds if every link does
        ("l <= q <= h", {"l": 0.0, "q": 1.0, "h": 2.0}, True),
        ("l <= q <= h", {"l": 0.0, "q": 3.0, "h": 2.0}, False),
        ("l <= q <= h", {"l": 1.5, "q": 1.0, "h": 2.0}, False),
        # of arrays, if it does for every entry
        ("q <= h", {"q": np.array([1.0, 2.0]), "h": 2.0}, True),
        ("q <= h", {"q": np.array([1.0, 2.1]), "h": 2.0}, False),
        ("rank(J) = min(m, n)", {"rank": np.linalg.matrix_rank, "min": min, "J": A,
                                 "m": 2, "n": 3}, True),
        ("rank(J) = min(m, n)", {"rank": np.linalg.matrix_rank, "min": min, "J": np.ones((2, 2)),
                                 "m": 2, "n": 3}, False),
    ],
)  # fmt: skip
def test_relations(text, names, true):
    assert holds(text, names) is true


def test_a_relation_needs_two_sides():
    with pytest.raises(DataFileError, match="sides joined by a relation"):
        holds("a + b", {"a": 1.0, "b": 2.0})


def test_symbols_commute_once_they_are_named():
    x, y = sp.symbols("x y")
    assert sp.expand(in_symbols("(a + b)^2", a=x, b=y) - (x**2 + 2 * x * y + y**2)) == 0
    assert in_symbols("c = a - b", 1, a=x, b=y) == x - y
    # simultaneously: a takes the place of b and b that of a
    assert in_symbols("a - b", a=sp.Symbol("b"), b=sp.Symbol("a")) == sp.Symbol("b") - sp.Symbol(
        "a"
    )
    with pytest.raises(DataFileError, match="the names a"):
        in_symbols("a + b", a=x)


def test_what_is_printed_is_read_by_its_key(registry):
    assert printed_text("pan.eq13", "X_dot")["stack"] == ["x1_dot", "x2_dot"]
    assert printed_text("pan.eq01") == registry.printed("pan.eq01")["formula"]
