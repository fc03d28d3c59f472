"""Exact angles of the robot files."""

import math
from fractions import Fraction

import pytest

from dualarm_repro.arms.angle import Angle


@pytest.mark.parametrize(
    ("written", "coefficient", "of_pi"),
    [
        ("pi", 1, True),
        ("-pi/2", Fraction(-1, 2), True),
        ("3*pi/4", Fraction(3, 4), True),
        ("+2 * pi", 2, True),
        ("76 deg", Fraction(76, 180), True),
        ("-196.5 deg", Fraction(-1965, 1800), True),
        (0, 0, False),
        (1.32, Fraction(132, 100), False),
    ],
)
def test_reads_exactly(written, coefficient, of_pi):
    angle = Angle.parse(written)
    assert angle == (coefficient, of_pi)
    assert float(angle) == pytest.approx(float(coefficient) * (math.pi if of_pi else 1), abs=1e-15)
    assert float(-angle) == -float(angle)
    assert Angle.parse(angle) is angle


@pytest.mark.parametrize(
    "written",
    [math.nan, math.inf, True, None, "", "90", "pi/0", "pi*2", "2pi", "1e400 deg", "deg", [1]],
)
def test_refuses(written):
    with pytest.raises(ValueError, match="an angle"):
        Angle.parse(written)
