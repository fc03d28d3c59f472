"""What printed digits promise."""

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.errors import InputError
from dualarm_repro.ledger.printed import at, leaves, read_number, replaced, rounds_to


@pytest.mark.parametrize(
    ("text", "value", "half_unit"),
    [
        ("0.285", 0.285, 0.0005),
        ("-0.250", -0.25, 0.0005),
        ("10", 10.0, 0.5),
        ("1.5e-3", 0.0015, 0.00005),
        ("-pi/8", -pi / 8, 1e-12),
        ("2*pi", 2 * pi, 1e-12),
        ("pi", pi, 1e-12),
    ],
)
def test_value_and_half_unit(text, value, half_unit):
    assert read_number(text) == pytest.approx((value, half_unit), rel=1e-12)


@pytest.mark.parametrize("text", ["", "pi/x", "nan", "inf", "1,5", "theta_1"])
def test_no_number(text):
    with pytest.raises(InputError, match="a decimal or a multiple of pi"):
        read_number(text)


@given(st.integers(-10_000, 10_000), st.floats(-0.499, 0.499))
def test_rounding_agrees_with_digits(thousandths, part):
    text = f"{thousandths / 1000:.3f}"
    assert rounds_to(thousandths / 1000 + part / 1000, text)
    assert not rounds_to(thousandths / 1000 + (part + (1.01 if part >= 0 else -1.01)) / 1000, text)


def test_nested_values():
    nested = {"a": ["1", {"b": "2"}], "c": "3"}
    assert dict(leaves(nested)) == {("a", 0): "1", ("a", 1, "b"): "2", ("c",): "3"}
    assert at(nested, "a.1.b") == "2"
    changed = replaced(nested, ("a", 1, "b"), "4")
    assert at(changed, "a.1.b") == "4"
    assert at(nested, "a.1.b") == "2"
    with pytest.raises(InputError, match=r"a\.7"):
        at(nested, "a.7")
