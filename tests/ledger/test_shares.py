"""Shares with intervals against scipy, and influence against shares that are known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binomtest

from dualarm_repro.ledger.influence import first_order
from dualarm_repro.ledger.shares import Share


@given(st.integers(1, 5000), st.floats(0.0, 1.0))
def test_interval_is_that_of_wilson(total, part):
    count = round(part * total)
    expected = binomtest(count, total).proportion_ci(method="wilson")
    found = Share.of(count, total)
    assert found.value == count / total
    assert found.low == pytest.approx(expected.low, abs=1e-9)
    assert found.high == pytest.approx(expected.high, abs=1e-9)


@pytest.mark.parametrize("total", range(1, 200))
def test_all_and_none_are_within_their_intervals(total):
    assert Share.of(total, total).high == 1.0
    assert Share.of(0, total).low == 0.0


def test_nothing_drawn_leaves_everything_possible():
    found = Share.of(0, 0)
    assert np.isnan(found.value)
    assert (found.low, found.high) == (0.0, 1.0)


def test_influence_finds_the_assumption_that_decides():
    rng = np.random.default_rng(1)
    decides, idle = rng.uniform(size=256), rng.uniform(size=256)
    met = decides > 0.5
    # the estimate corrects for the number of bins and stays below 1
    assert first_order(decides.tolist(), met.tolist(), 0) == pytest.approx(1.0, abs=0.05)
    assert first_order(idle.tolist(), met.tolist(), 0) is None


def test_influence_of_choices_and_of_what_never_changes():
    choices = ["a", "b"] * 32
    met = [choice == "a" for choice in choices]
    # the estimate corrects for the number of choices and stays below 1
    assert first_order(choices, met, 0) == pytest.approx(1.0, abs=0.05)
    assert first_order(choices, [True] * 64, 0) is None
