"""Suites are found, checked, timed and judged."""

import pytest
import suites
import timing
from claims import Claim
from goals import GOALS

SUITE = """
from equal_work import reference, same
from timing import OURS, timed

def measure():
    yield timed("add", OURS, lambda: sum(range(10)), 10, check=reference())
    yield timed("add", "peer", lambda: sum(range(99)), 10,
                check=same(lambda: 45.0, lambda: 45.0, 0.0))
    yield timed("add", "liar", lambda: None, 10, check=same(lambda: 45.0, lambda: 44.0, 0.5))
    yield timed("add", "unknown", lambda: None, 10)
    yield timed("add", "many", lambda: None, 10, threads=2)
"""


@pytest.fixture
def fake(tmp_path, monkeypatch):
    (tmp_path / "fake_suite_of_a_test.py").write_text(SUITE)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(timing, "TURN", 0.0)
    claims = (Claim("c", "add", 1e-9, None, "peer"), Claim("d", "add", 1e-9, None, "unknown"))
    monkeypatch.setitem(GOALS, "fake_suite_of_a_test", claims)
    return "fake_suite_of_a_test"


def test_rows_of_other_work_are_named_and_not_timed(fake):
    found = suites.run(fake, 5, 1.0)
    assert [row["implementation"] for row in found["rows"]] == [timing.OURS, "peer", "unknown"]
    (liar,) = found["different"]
    assert (liar["implementation"], liar["reason"]) == ("liar", "differs by 1, more than 0.5")


def test_rows_say_what_was_checked_and_how_they_compare(fake):
    ours, peer, unknown = suites.run(fake, 5, 1.0)["rows"]
    assert ours["ratio"] == 1.0
    assert peer["ratio"] == pytest.approx(peer["microseconds"] / ours["microseconds"])
    assert peer["quartiles"][0] <= peer["microseconds"] <= peer["quartiles"][1]
    assert [r["same_work"] for r in (ours, peer, unknown)] == [
        "the reference", "equal to 0e+00", None,
    ]  # fmt: skip


def test_claims_are_judged_with_the_checks(fake):
    held, unchecked = suites.run(fake, 5, 1.0)["claims"]
    assert held["gate_holds"] is True
    assert unchecked["reason"] == "not checked to be the same work"


def test_rows_of_threads_are_asked_for(fake):
    found = suites.run(fake, 5, 1.0, threads=True)
    assert ("many", 2) in {(row["implementation"], row["threads"]) for row in found["rows"]}


def test_every_suite_is_found_and_nothing_else():
    names = suites.names()
    assert {"kinematics", "planning", "control", "welding", "start_up"} <= set(names)
    assert not {"run", "timing", "suites", "growth", "claims"} & set(names)


def test_goals_are_those_of_suites():
    assert set(GOALS) <= set(suites.names())
    for name, claims in GOALS.items():
        text = (suites.FOLDER / f"{name}.py").read_text(encoding="utf-8")
        for claim in claims:
            assert f'"{claim.task}"' in text, f"{name}: {claim.task}"
            assert claim.peer is None or f'"{claim.peer}"' in text, f"{name}: {claim.peer}"
