"""An axis of a drawing: a straight map with round ticks inside."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.view.slices.axis import Axis


def test_ends_lie_at_the_ends_and_the_middle_in_the_middle():
    axis = Axis("x [m]", -1.0, 3.0, 64.0, 564.0)
    assert [axis.at(value) for value in (-1.0, 0.0, 1.0, 3.0)] == [64.0, 189.0, 314.0, 564.0]
    upright = Axis("U", 0.0, 2.0, 300.0, 30.0)
    assert upright.at(0.5) == 232.5, "larger values stand higher"
    assert axis.at(1.0 / 3.0) == 230.7, "to a tenth of a pixel"


@settings(max_examples=50)
@given(st.floats(-1e3, 1e3), st.floats(1e-3, 1e3))
def test_ticks_are_round_inside_and_told_exactly(low, span):
    axis = Axis("x", low, low + span, 0.0, 1000.0)
    ticks = axis.ticks
    assert 2 <= len(ticks) <= 8
    told = [float(text.replace("−", "-")) for _, text in ticks]
    assert told == sorted(set(told)), "no two alike"
    for (place, _), value in zip(ticks, told, strict=True):
        assert low - 1e-6 * span <= value <= low + 1.000001 * span
        # a tenth of a pixel, and what the digits of a text leave off
        assert place == pytest.approx(axis.at(value), abs=0.11)
    steps = np.diff(told)
    np.testing.assert_allclose(steps, steps[0], rtol=1e-6, atol=1e-9 * span)
    leading = steps[0] / 10.0 ** np.floor(np.log10(steps[0]) + 1e-9)
    assert min(abs(leading - one) for one in (1.0, 2.0, 2.5, 5.0, 10.0)) < 1e-6


@pytest.mark.parametrize(
    ("low", "high", "texts"),
    [(0.0, 1.0, ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]),
     (-1.0, 1.0, ["−1.0", "−0.5", "0.0", "0.5", "1.0"]),
     (0.0, 0.1, ["0.00", "0.02", "0.04", "0.06", "0.08", "0.10"]),
     (0.0, 50.0, ["0", "10", "20", "30", "40", "50"])],
)  # fmt: skip
def test_texts_have_the_digits_of_the_step(low, high, texts):
    assert [text for _, text in Axis("x", low, high, 0.0, 1.0).ticks] == texts


def test_a_quarter_step_has_its_two_digits():
    texts = [text for _, text in Axis("x", 0.0, 1.25, 0.0, 1.0).ticks]
    assert texts == ["0.00", "0.25", "0.50", "0.75", "1.00", "1.25"]
