"""Implementations are called by turns, and medians are of one item."""

import subprocess
import sys

import pytest
import timing
from timing import Row, Spread, by_turns, cpu_time, timed


@pytest.fixture
def no_repeats(monkeypatch):
    """One call a turn, so that the order of calls is seen."""
    monkeypatch.setattr(timing, "TURN", 0.0)


def recorded(names):
    calls = []
    return calls, [Row("task", name, lambda name=name: calls.append(name), 1) for name in names]


def test_each_round_calls_every_row_once_and_begins_with_another(no_repeats):
    calls, rows = recorded("abc")
    by_turns(rows, rounds=3)
    warm, rounds = calls[:6], [calls[k : k + 3] for k in range(6, len(calls), 3)]
    assert warm == list("abcabc")
    assert rounds == [list("abc"), list("bca"), list("cab")]


def test_no_round_begins_after_the_budget_but_the_fewest_do(no_repeats):
    (timing_of_row,) = by_turns(recorded("a")[1], rounds=100, budget=0.0)
    assert timing_of_row.rounds == timing.FEWEST


def test_a_row_of_one_round_is_called_twice(no_repeats):
    calls = []
    (found,) = by_turns([timed("t", "long", lambda: calls.append(1), 1, rounds=1)], rounds=9)
    assert (len(calls), found.rounds) == (2, 1)


def test_short_calls_fill_a_turn():
    calls = []
    by_turns([timed("t", "short", lambda: calls.append(1), 1)], rounds=1)
    assert len(calls) > 50


def test_times_are_of_one_item(monkeypatch):
    """A call of 8 items that takes 4 s, 2 s of them CPU time, takes half and a quarter an item."""
    monkeypatch.setattr(timing, "_once", lambda call, times: (4.0, 2.0))
    (found,) = by_turns([timed("t", "a", lambda: None, 8)], rounds=3)
    assert (found.wall.median, found.cpu.median, found.first) == (0.5, 0.25, 4.0)


def test_spread():
    assert Spread.of([5.0, 1.0, 3.0, 2.0, 4.0]) == Spread(3.0, 2.0, 4.0)


def test_time_of_children_counts():
    before = cpu_time()
    subprocess.run([sys.executable, "-c", "sum(range(2_000_000))"], check=True)
    assert cpu_time() - before > 0.01


def test_nothing_to_time():
    assert by_turns([]) == []
