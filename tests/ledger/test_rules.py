"""Every rule can hold, can fail, and knows how to be flipped."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.errors import LedgerError
from dualarm_repro.ledger import (
    Adopts,
    Bounded,
    Exceeds,
    Generally,
    Is,
    NoOriginal,
    Role,
    Rounds,
    Verdict,
)
from dualarm_repro.ledger.rules import Evidence, Outcome
from dualarm_repro.ledger.verdict import decide

PRINTED = {"p": ["0.12", "-1.5"], "n": "8", "word": "left", "q": ["0", "-pi/2"]}
PI = 3.141592653589793

CASES = [
    (Rounds(key="x", label="x", to="p"), [0.1249, -1.52], [0.1251, -1.52]),
    (Rounds(key="x", label="x", to="p"), [0.12, -1.5], [0.12]),
    (Rounds(key="x", label="x", to="p"), [0.12, -1.5], [0.12, float("nan")]),
    (Rounds(key="x", label="x", to="p", tolerance=0.1, reason="r"), [0.21, -1.5], [0.23, -1.5]),
    (Bounded(key="x", label="x", low=1.0), 1.0, 0.99),
    (Bounded(key="x", label="x", high=0.0), 0.0, 1e-9),
    (Bounded(key="x", label="x", low=0.1, high=0.9), 0.5, None),
    (Bounded(key="x", label="x", low=0.1, high=0.9), 0.9, float("nan")),
    (Is(key="x", label="x", value=True), True, 1),
    (Is(key="x", label="x", value=6), 6, 7),
    (Is(key="x", label="x", to="n"), 8, 9),
    (Is(key="x", label="x", to="word"), "left", "right"),
    (Adopts(key="x", label="x", to="q"), [0.0, -PI / 2], [0.1, -PI / 2]),
    (Bounded("x", "x", high="limit"), 0.25, 0.26),
    (Generally("x", "x", at_least=0.9), {"count": 100, "of": 100}, {"count": 50, "of": 100}),
    (Generally("x", "x", at_most="limit"), {"count": 0, "of": 100}, {"count": 50, "of": 100}),
    (Generally("x", "x", at_least=0.5), {"count": 90, "of": 100}, {"count": 0, "of": 0}),
    (Exceeds("x", "x"), {"value": 1, "low": 0.1, "high": 2}, {"value": 1, "low": -0.1, "high": 2}),
]


@pytest.mark.parametrize(("rule", "good", "bad"), CASES)
def test_holds_and_fails(rule, good, bad):
    for value, expected in ((good, True), (bad, False)):
        evidence = Evidence({"x": value}, PRINTED, {"limit": 0.25})
        assert rule.holds(evidence) is expected
        assert rule.holds(rule.flipped(evidence)) is not expected
        assert (rule.outcome(evidence) is Outcome.HOLDS) is expected
        assert (rule.miss(evidence) == 0.0) is expected
        assert rule.expectation(evidence)


def test_no_original_looks_at_print_only():
    rule = NoOriginal("size", "the drawing")
    for printed in (None, {"n": "8"}, {"size": "0.7"}):
        evidence = Evidence({}, printed)
        assert rule.holds(evidence) is not (printed is not None and "size" in printed)
        assert rule.holds(rule.flipped(evidence)) is not rule.holds(evidence)


def test_threshold_must_be_declared():
    with pytest.raises(LedgerError, match="no threshold named 'limit'"):
        Bounded("x", "x", high="limit").holds(Evidence({"x": 1.0}, None))


@pytest.mark.parametrize(
    ("rule", "found", "outcome"),
    [
        (Generally("x", "x", at_least=0.9), {"count": 9, "of": 10}, Outcome.OPEN),
        (Generally("x", "x", at_least=0.9), {"count": 70, "of": 100}, Outcome.FAILS),
        (Generally("x", "x", at_least=0.9, margin=0.3), {"count": 70, "of": 100}, Outcome.OPEN),
        (Generally("x", "x", at_most=0.1), {"count": 30, "of": 100}, Outcome.FAILS),
        (Generally("x", "x", at_most=0.1), {"count": 1, "of": 10}, Outcome.OPEN),
        (Exceeds("x", "x", threshold=1.0), {"value": 0, "low": -1, "high": 0.9}, Outcome.FAILS),
        (Exceeds("x", "x", threshold=1.0), {"value": 1, "low": 0.5, "high": 1.5}, Outcome.OPEN),
    ],
)
def test_three_answers(rule, found, outcome):
    assert rule.outcome(Evidence({"x": found}, None)) is outcome


@given(st.integers(0, 60), st.integers(2, 40), st.floats(0.05, 0.95), st.floats(0.0, 0.2))
def test_more_draws_of_the_same_share_only_settle_what_is_open(count, times, limit, margin):
    rule = Generally("x", "x", at_least=limit, margin=margin)
    few = rule.outcome(Evidence({"x": {"count": count, "of": 60}}, None))
    many = rule.outcome(Evidence({"x": {"count": times * count, "of": times * 60}}, None))
    assert few is Outcome.OPEN or many is few


@given(st.floats(0.0, 2.0), st.floats(0.0, 2.0), st.floats(0.0, 3.0))
def test_a_wider_bound_never_fails_what_a_narrower_holds(narrow, further, value):
    evidence = Evidence({"x": value}, None)
    if Bounded("x", "x", high=narrow).holds(evidence):
        assert Bounded("x", "x", high=narrow + further).holds(evidence)


def test_rules_refuse_to_be_vague():
    with pytest.raises(ValueError, match="reason"):
        Rounds(key="x", label="x", to="p", tolerance=0.1)
    with pytest.raises(ValueError, match="bound"):
        Bounded(key="x", label="x")
    with pytest.raises(ValueError, match="either"):
        Is(key="x", label="x")


def _supports(value):
    return Is(key=value, label="s", value=True)


def _contradicts(value):
    return Is(key=value, label="c", value=True, role=Role.CONTRADICTS)


@pytest.mark.parametrize(
    ("rules", "options", "verdict"),
    [
        ([_supports("yes")], {}, Verdict.REPRODUCED),
        ([_supports("yes")], {"assumed": True}, Verdict.UNDER_ASSUMPTION),
        ([_supports("no")], {"assumed": True}, Verdict.NOT_REPRODUCED),
        ([_supports("yes"), _contradicts("yes")], {}, Verdict.INCONSISTENT),
        ([_supports("yes"), _contradicts("no")], {}, Verdict.REPRODUCED),
        ([_supports("no"), _contradicts("yes")], {}, Verdict.INCONSISTENT),
        ([_contradicts("yes"), _contradicts("no")], {}, Verdict.REPRODUCED),
        ([NoOriginal("z", "z")], {"assumed": True}, Verdict.REGENERATED),
        ([_supports("yes"), NoOriginal("z", "z")], {}, Verdict.REGENERATED),
        ([_supports("no"), NoOriginal("z", "z")], {}, Verdict.NOT_REPRODUCED),
        ([NoOriginal("n", "n")], {}, Verdict.NOT_ATTEMPTED),
        ([_supports("yes"), Generally("few", "few", at_least=0.9)], {}, Verdict.UNDECIDABLE),
        ([_supports("no"), Generally("few", "few", at_least=0.9)], {}, Verdict.NOT_REPRODUCED),
        ([Adopts(key="v", label="v", to="n")], {}, Verdict.ADOPTED),
        ([Adopts(key="w", label="w", to="n")], {"change": "doubled"}, Verdict.ADAPTED),
        ([Adopts(key="w", label="w", to="n")], {}, Verdict.NOT_REPRODUCED),
    ],
)
def test_decision_table(rules, options, verdict):
    few = {"count": 9, "of": 10}
    evidence = Evidence({"yes": True, "no": False, "v": 8.0, "w": 16.0, "few": few}, PRINTED)
    assert decide(rules, evidence, **options) is verdict


def test_no_rule_no_verdict():
    with pytest.raises(ValueError, match="at least one"):
        decide([], Evidence({}, None))


@pytest.mark.parametrize(("obtained", "expected"), [(np.True_, True), (np.int64(3), 3)])
def test_numpy_scalars_count_as_what_they_are(obtained, expected):
    rule = Is(key="x", label="x", value=expected)
    assert rule.holds(Evidence({"x": obtained}, {}))
    assert not rule.holds(Evidence({"x": not obtained}, {}))
