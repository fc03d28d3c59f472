"""Statements about populations: their edges, how far they miss, and that draws only help."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import binomtest

from dualarm_repro.errors import LedgerError
from dualarm_repro.ledger import Exceeds, Generally
from dualarm_repro.ledger.rules import Evidence, Outcome

WORSE = {Outcome.HOLDS: 2, Outcome.OPEN: 1, Outcome.FAILS: 0}


def evidence(found, **thresholds):
    return Evidence({"x": found}, None, thresholds)


def share(count, of=60):
    return evidence({"count": count, "of": of})


@settings(max_examples=40)
@given(count=st.integers(0, 200), limit=st.floats(0.0, 1.0), margin=st.floats(0.0, 0.3))
def test_the_outcome_is_that_of_the_interval_of_scipy(count, limit, margin):
    interval = binomtest(count, 200).proportion_ci(method="wilson")
    low, high = float(interval.low), float(interval.high)
    for end in (low, high):  # an edge within rounding may fall to either side
        if min(abs(end - limit), abs(end - limit + margin), abs(end - limit - margin)) < 1e-9:
            return
    least = Generally("x", "x", at_least=limit, margin=margin).outcome(share(count, 200))
    assert (least is Outcome.HOLDS) is (low >= limit)
    assert (least is Outcome.FAILS) is (low < limit and high < limit - margin)
    most = Generally("x", "x", at_most=limit, margin=margin).outcome(share(count, 200))
    assert (most is Outcome.HOLDS) is (high <= limit)
    assert (most is Outcome.FAILS) is (high > limit and low > limit + margin)


@settings(max_examples=30)
@given(count=st.integers(0, 60), limit=st.floats(0.05, 0.95), margin=st.floats(0.0, 0.3))
def test_at_least_of_a_share_is_at_most_of_the_rest(count, limit, margin):
    least = Generally("x", "x", at_least=limit, margin=margin)
    most = Generally("x", "x", at_most=1.0 - limit, margin=margin)
    interval = least.share(share(count))
    for end in (interval.low, interval.high):
        if min(abs(end - limit), abs(end - limit + margin)) < 1e-9:
            return
    assert least.outcome(share(count)) is most.outcome(share(60 - count))
    assert least.miss(share(count)) == pytest.approx(most.miss(share(60 - count)))


@settings(max_examples=30)
@given(
    count=st.integers(0, 59),
    limit=st.floats(0.05, 0.9),
    margin=st.floats(0.0, 0.3),
    further=st.floats(0.0, 0.1),
)
def test_a_verdict_never_gets_worse_with_more_hits_a_lower_limit_or_more_margin(
    count, limit, margin, further
):
    rule = Generally("x", "x", at_least=limit, margin=margin)
    now = WORSE[rule.outcome(share(count))]
    assert WORSE[rule.outcome(share(count + 1))] >= now
    assert (
        WORSE[Generally("x", "x", at_least=limit - further).outcome(share(count))]
        >= (WORSE[Generally("x", "x", at_least=limit).outcome(share(count))])
    )
    wider = Generally("x", "x", at_least=limit, margin=margin + further)
    assert WORSE[wider.outcome(share(count))] >= now
    assert rule.miss(share(count + 1)) <= rule.miss(share(count)) + 1e-12


def test_a_miss_is_the_distance_from_the_limit():
    rule = Generally("x", "x", at_least=0.9)
    assert rule.miss(share(30)) == pytest.approx(0.4)
    assert rule.miss(evidence({"count": 600, "of": 600})) == 0.0
    assert Exceeds("x", "x", threshold=1.0).miss(
        evidence({"value": 1, "low": 0.25, "high": 2})
    ) == pytest.approx(0.75)


def test_the_words_of_a_statement_name_both_edges():
    assert (
        Generally("x", "x", at_least=0.9, margin=0.2).expectation(share(1))
        == "at least 0.9 of the population; fails below 0.7, else open"
    )
    named = Generally("x", "x", at_most="most", margin="slack")
    assert (
        named.expectation(evidence({"count": 1, "of": 2}, most=0.1, slack=0.05))
        == "at most 0.1 of the population; fails above 0.15, else open"
    )
    assert Exceeds("x", "x", threshold="edge").expectation(evidence({}, edge=2.5)) == (
        "interval above 2.5; fails below, else open"
    )


def test_an_edge_that_is_met_exactly():
    rule = Exceeds("x", "x", threshold=1.0)
    assert rule.outcome(evidence({"value": 2, "low": 1.0, "high": 3})) is Outcome.OPEN
    assert rule.outcome(evidence({"value": 0, "low": -1, "high": 1.0})) is Outcome.OPEN
    assert rule.outcome(evidence({"value": 2, "low": 1.0 + 1e-12, "high": 3})) is Outcome.HOLDS


@pytest.mark.parametrize("both", [{}, {"at_least": 0.5, "at_most": 0.6}])
def test_a_statement_has_one_side(both):
    with pytest.raises(ValueError, match="either at_least or at_most"):
        Generally("x", "x", **both)


@pytest.mark.parametrize(
    "rule", [Generally("x", "x", at_least="edge"), Exceeds("x", "x", threshold="edge")]
)
def test_a_limit_that_is_named_has_to_be_declared(rule):
    found = evidence({"count": 1, "of": 2, "low": 0, "high": 1, "value": 0.5})
    with pytest.raises(LedgerError, match="no threshold named 'edge'"):
        rule.outcome(found)
