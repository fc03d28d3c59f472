"""How far rules miss, in the units a directed search climbs by, and the words for the reader."""

from math import inf

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.ledger import Adopts, Bounded, Is, Residual, Role, Rounds
from dualarm_repro.ledger.rules import Evidence
from dualarm_repro.ledger.verdict import Verdict, decide

PRINTED = {"p": ["0.50", "-2.0"], "one": "4.0", "zero": "0.0", "names": {"a": "x", "b": ["y", "z"]}}


def seen(value, **thresholds):
    return Evidence({"x": value}, PRINTED, thresholds)


@pytest.mark.parametrize(
    ("rule", "value", "miss"),
    [
        (Rounds("x", "x", to="one"), 4.04, 0.0),
        (Rounds("x", "x", to="one"), 5.0, 0.25),
        (Rounds("x", "x", to="p"), [0.5, -3.0], 0.5),
        (Rounds("x", "x", to="p"), [0.6, -2.1], 0.2),
        # Of a printed zero the gap counts in half units of its last digit.
        (Rounds("x", "x", to="zero"), 0.2, 4.0),
        (Rounds("x", "x", to="p"), [0.5], inf),
        (Rounds("x", "x", to="one"), inf, inf),
        (Rounds("x", "x", to="one"), "4.0", inf),
        (Rounds("x", "x", to="one"), True, inf),
        (Bounded("x", "x", low=2.0), 1.5, 0.25),
        (Bounded("x", "x", high=2.0), 3.0, 0.5),
        (Bounded("x", "x", high=0.0), 1e-9, 1.0),
        (Bounded("x", "x", low=1.0, high=4.0), 6.0, 0.5),
        (Bounded("x", "x", low=1.0), None, inf),
        (Bounded("x", "x", low=1.0), inf, inf),
        (Residual("x", "x", high=0.5), 0.75, 0.5),
        (Is("x", "x", value=3), 4, 1.0),
    ],
)
def test_misses_by_hand(rule, value, miss):
    assert rule.miss(seen(value)) == pytest.approx(miss)


@settings(max_examples=40)
@given(off=st.floats(0.06, 50.0), further=st.floats(1e-3, 10.0), side=st.sampled_from([-1, 1]))
def test_farther_from_print_misses_by_more(off, further, side):
    rounds, within = Rounds("x", "x", to="one"), Bounded("x", "x", low=3.95, high=4.05)
    for rule in (rounds, within):
        near, far = (rule.miss(seen(4.0 + side * by)) for by in (off, off + further))
        assert 0.0 < near < far


@settings(max_examples=40)
@given(value=st.floats(-10, 10), tolerance=st.floats(0.01, 5.0), more=st.floats(0.0, 5.0))
def test_a_verdict_is_monotone_in_the_tolerance(value, tolerance, more):
    """What one tolerance reproduces every wider one does."""
    narrow, wide = (
        Rounds("x", "x", to="one", tolerance=t, reason="r") for t in (tolerance, tolerance + more)
    )
    if decide([narrow], seen(value)) is Verdict.REPRODUCED:
        assert decide([wide], seen(value)) is Verdict.REPRODUCED
    assert wide.miss(seen(value)) <= narrow.miss(seen(value))
    bounds = Bounded("x", "x", low=4.0 - tolerance, high=4.0 + tolerance)
    assert bounds.holds(seen(value)) is (4.0 - tolerance <= value <= 4.0 + tolerance)


@pytest.mark.parametrize(
    ("rule", "words"),
    [
        (Rounds("x", "x", to="p"), "printed (0.50, -2.0)"),
        (
            Rounds("x", "x", to="one", tolerance=0.25, reason="read off"),
            "printed 4.0 within 0.25 (read off)",
        ),
        (Bounded("x", "x", low=1.0), "at least 1"),
        (Bounded("x", "x", high="most"), "at most 0.3"),
        (Bounded("x", "x", low=1.0, high=2.5), "between 1 and 2.5"),
        (Is("x", "x", to="names"), "a: x; b: (y, z)"),
        (Is("x", "x", value=True), "True"),
        (Adopts("x", "x", to="one"), "printed 4.0"),
    ],
)
def test_expectations_for_the_reader(rule, words):
    assert rule.expectation(seen(0.0, most=0.3)) == words


def test_nested_texts_are_compared_leaf_by_leaf():
    rule = Is("x", "x", to="names")
    assert rule.holds(seen({"a": "x", "b": ["y", "z"]}))
    assert not rule.holds(seen({"a": "x", "b": ["z", "y"]}))
    assert not rule.holds(seen({"a": "x", "b": ["y"]}))
    assert not rule.holds(seen({"a": "x"}))


def test_an_input_is_met_to_the_last_bit_that_decimals_have():
    rule = Adopts("x", "x", to="one")
    assert rule.role is Role.ADOPTS
    assert rule.holds(seen(4.0))
    assert not rule.holds(seen(4.0 + 1e-11))  # it would round to the print


def test_a_key_leads_into_what_was_obtained_and_flips_only_there():
    obtained = {"rows": [{"a": 1.0}, {"a": 4.0}], "other": 2}
    rule = Rounds("rows.1.a", "x", to="one")
    flipped = rule.flipped(Evidence(obtained, PRINTED))
    assert rule.holds(Evidence(obtained, PRINTED))
    assert not rule.holds(flipped)
    assert flipped.obtained["rows"][0] == {"a": 1.0}
    assert flipped.obtained["other"] == 2
    assert obtained["rows"][1] == {"a": 4.0}, "the evidence itself is left alone"
