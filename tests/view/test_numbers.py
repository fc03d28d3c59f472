"""Numbers as a reader wants them: read back, they are the number to the digits shown."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.view.numbers import beside, number, words

FINITE = st.floats(min_value=1e-12, max_value=1e12, allow_nan=False)
_RAISED_SIGNS = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"
_RAISED = str.maketrans(_RAISED_SIGNS, "-0123456789")


def read(text):
    """A number from how it is told."""
    head, times, power = text.partition(" × ")
    if not times and text.startswith("10") and any(sign in text for sign in _RAISED_SIGNS):
        head, power = "1", text
    return float(head) * (10.0 ** int(power[2:].translate(_RAISED)) if power else 1.0)


@settings(max_examples=50)
@given(FINITE)
def test_digits_that_are_shown_are_right(value):
    """Half a unit of the third digit, of the second in powers of ten."""
    text = number(value)
    digits = 2 if any(sign in text for sign in _RAISED_SIGNS) else 3
    # half a unit of the last digit shown
    assert read(text) == pytest.approx(value, rel=0.5001 * 10.0 ** (1 - digits))
    assert len(text) <= 11
    told = number(-value)
    assert told.startswith("-")
    assert read(told[1:]) == read(text)


@pytest.mark.parametrize(
    ("value", "text"),
    [(99949.0, "99949"), (99951.0, "10⁵"), (123456.0, "1.2 × 10⁵"), (1e-4, "0.0001"),
     (0.00012349, "0.000123"), (0.99999e-4, "0.0001"), (9.4e-5, "9.4 × 10⁻⁵"),
     (float("nan"), "none"), (-math.inf, "minus infinite"), (12345678, "12345678"), (2.0, "2")],
)  # fmt: skip
def test_ends_of_the_plain_form(value, text):
    assert number(value) == text


@pytest.mark.parametrize(
    ("value", "printed", "text"),
    [(0.41049, "0.41", "0.410"), (0.5, "0.5000", "0.50000"), (-0.0, "1.0", "0.00"),
     (3.14159, "3", "3.14"), (math.inf, "0.5", "infinite"), (2, "1.5", "2"),
     (0.123456, "about .5x", "0.123")],
)  # fmt: skip
def test_a_number_follows_the_digits_in_print(value, printed, text):
    assert beside(value, printed) == text


def test_entries_of_a_vector_are_rounded_alike():
    assert words([0.12345, -12.3456, 1e-13]) == "(0.12, -12.35, 0)"
    assert words([1e-9, 2e-9]) == "(10⁻⁹, 2 × 10⁻⁹)"
    assert words([1.0, float("nan")]) == "(1, none)"
    assert words([-1e-5, 1.0]) == "(0, 1)", "no minus zero"
    assert words([1, 2, 3]) == "(1, 2, 3)"
    assert words([]) == "()"


def test_a_long_list_is_counted():
    told = words(list(range(20)))
    assert told == "(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, and 8 more)"
    assert "more" not in words(list(range(12)))


def test_units_stand_behind_every_kind_of_value():
    assert words(0.5, "m") == "0.5 m"
    assert words([0.5, 1.0], "m") == "(0.5, 1) m"
    assert words("sum_over_bars", "m") == "sum over bars m"
    assert words("2 x 3", "m") == "2 x 3 m"
    assert words(float("nan"), "m") == "none"
    assert words(None, "m") == "none"
    assert words({"a_b": 0.5, "c": True}, "m") == "a b: 0.5 m; c: yes"


def test_counts_of_nothing_are_no_share():
    assert words({"count": 0, "of": 0}) == "count: 0; of: 0"
    assert words({"count": 1, "of": 3}) == "1 of 3 (33 %)"
    assert words({"value": 0.5, "low": 0.25, "high": 0.75}, "m") == (
        "0.5 m (95 % interval 0.25 to 0.75)"
    )


def test_an_array_entry_is_told_like_a_float():
    assert words([float(v) for v in np.array([0.25, 0.5])]) == "(0.25, 0.5)"
