"""A claim is judged by the worse ratio of wall and CPU time, and never without a check."""

import pytest
from claims import Claim, Kind, judged, value_of
from hypothesis import given
from hypothesis import strategies as st
from timing import OURS, Row, Spread, Timing

CHECKED = {OURS: "the reference", "peer": "equal to 1e-09"}
seconds = st.floats(1e-9, 1e3)


def timing(name, wall, cpu, items=1):
    spreads = (Spread(value, value, value) for value in (wall, cpu))
    return Timing(Row("task", name, lambda: None, items), *spreads, 0.1, 5)


OF_OURS, OF_PEER = timing(OURS, 1.0, 1.0), timing("peer", 40.0, 20.0)


@pytest.mark.parametrize(
    ("gate", "goal", "holds", "reached"),
    [(20.0, 21.0, True, False), (20.0, 20.0, True, True), (20.1, 30.0, False, False)],
)
def test_the_worse_ratio_decides(gate, goal, holds, reached):
    found = judged(Claim("c", "task", gate, goal, "peer"), [OF_OURS, OF_PEER], CHECKED)
    assert found["value"] == 20.0
    assert (found["gate_holds"], found["goal_holds"]) == (holds, reached)


def test_at_most():
    claim = Claim("c", "task", 0.05, None, "peer", Kind.AT_MOST)
    found = judged(claim, [OF_OURS, OF_PEER], CHECKED)
    assert (found["value"], found["gate_holds"], found["goal_holds"]) == (0.05, True, None)


def test_seconds_are_those_of_a_call():
    claim = Claim("c", "task", 0.3, kind=Kind.SECONDS)
    found = judged(claim, [timing(OURS, 0.1, 0.1, items=4)], {})
    assert found["value"] == pytest.approx(0.4)
    assert found["gate_holds"] is False


def test_a_missing_peer_is_named():
    found = judged(Claim("c", "task", 2.0, None, "peer"), [OF_OURS], CHECKED)
    assert (found["value"], found["gate_holds"]) == (None, None)
    assert found["reason"] == "not measured: peer"


def test_unchecked_work_decides_nothing():
    claim = Claim("c", "task", 2.0, None, "peer")
    found = judged(claim, [OF_OURS, OF_PEER], {**CHECKED, "peer": ""})
    assert (found["value"], found["reason"]) == (None, "not checked to be the same work")


@given(seconds, seconds, seconds, seconds)
def test_at_most_is_the_inverse_of_faster(a, b, c, d):
    """So that a claim that is turned round is judged as strictly."""
    ours, peer = timing(OURS, a, b), timing("peer", c, d)
    product = value_of(Kind.FASTER, ours, peer) * value_of(Kind.AT_MOST, ours, peer)
    assert product == pytest.approx(1.0)
