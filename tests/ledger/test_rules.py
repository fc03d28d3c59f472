"""Every rule can hold, can fail, and knows how to be flipped."""

import numpy as np
import pytest

from dualarm_repro.ledger import Adopts, Bounded, Is, NeedsPrinted, Role, Rounds, Verdict
from dualarm_repro.ledger.rules import Evidence
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
]


@pytest.mark.parametrize(("rule", "good", "bad"), CASES)
def test_holds_and_fails(rule, good, bad):
    for value, expected in ((good, True), (bad, False)):
        evidence = Evidence({"x": value}, PRINTED)
        assert rule.holds(evidence) is expected
        assert rule.holds(rule.flipped(evidence)) is not expected
        assert rule.expectation(evidence)


def test_needs_printed_looks_at_print_only():
    rule = NeedsPrinted(key="size", label="the size")
    for printed in (None, {"n": "8"}, {"size": "0.7"}):
        evidence = Evidence({}, printed)
        assert rule.holds(evidence) is (printed is not None and "size" in printed)
        assert rule.holds(rule.flipped(evidence)) is not rule.holds(evidence)


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
        ([_supports("no"), _contradicts("yes")], {}, Verdict.NOT_REPRODUCED),
        ([_contradicts("yes"), _contradicts("no")], {}, Verdict.REPRODUCED),
        ([NeedsPrinted(key="z", label="z")], {"assumed": True}, Verdict.UNDECIDABLE),
        ([_supports("no"), NeedsPrinted(key="z", label="z")], {}, Verdict.NOT_REPRODUCED),
        ([Adopts(key="v", label="v", to="n")], {}, Verdict.ADOPTED),
        ([Adopts(key="w", label="w", to="n")], {"change": "doubled"}, Verdict.ADAPTED),
        ([Adopts(key="w", label="w", to="n")], {}, Verdict.NOT_REPRODUCED),
    ],
)
def test_decision_table(rules, options, verdict):
    evidence = Evidence({"yes": True, "no": False, "v": 8.0, "w": 16.0}, PRINTED)
    assert decide(rules, evidence, **options) is verdict


def test_no_rule_no_verdict():
    with pytest.raises(ValueError, match="at least one"):
        decide([], Evidence({}, None))


@pytest.mark.parametrize(("obtained", "expected"), [(np.True_, True), (np.int64(3), 3)])
def test_numpy_scalars_count_as_what_they_are(obtained, expected):
    rule = Is(key="x", label="x", value=expected)
    assert rule.holds(Evidence({"x": obtained}, {}))
    assert not rule.holds(Evidence({"x": not obtained}, {}))
