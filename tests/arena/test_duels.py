"""Duels of the arena, from rows whose answer is counted by hand."""

import contest_rows
import numpy as np
import pandas as pd
import pytest
from contest_rows import A, B

from dualarm_repro.arena.duels import against, compared, duel, halves, paired_difference, successes
from dualarm_repro.arena.summary import contest


@pytest.fixture
def rows():
    return contest(contest_rows.table())


def test_a_task_is_counted_once_and_only_if_somebody_can_do_it(rows):
    done = successes(rows)
    assert done[A].tolist() == [True, True, False]
    assert done[B].tolist() == [True, False, False]


def test_duel_counts_what_one_does_alone(rows):
    found = duel(rows, B, A)
    assert (found.tasks, found.only_first, found.only_second) == (3, 0, 1)
    assert found.difference.value == pytest.approx(-1 / 3)
    assert found.verdict == "undecided"  # a single task decides nothing
    assert found.told.startswith("-33% [")


def outcomes(both, first, second, neither):
    a = [1] * both + [1] * first + [0] * second + [0] * neither
    b = [1] * both + [0] * first + [1] * second + [0] * neither
    return np.array(a, dtype=bool), np.array(b, dtype=bool)


@pytest.mark.parametrize(
    ("counts", "low", "high"),
    [  # Wilson's ends are 0.1261 and 0.1060 away, the correlation is 1/2; the second is one-sided
        ((20, 20, 0, 20), 1 / 3 - 0.1261, 1 / 3 + 0.1060),
        ((0, 36, 0, 0), 1 - np.sqrt(2) * 0.096419, 1.0),
    ],
)
def test_interval_of_newcombe(counts, low, high):
    a, b = outcomes(*counts)
    found = paired_difference(a, b)
    assert (found.low, found.high) == pytest.approx((low, high), abs=1e-4)
    swapped = paired_difference(b, a)
    assert (swapped.low, swapped.high) == pytest.approx((-found.high, -found.low))


def test_many_tasks_decide(rows):
    many = pd.concat([rows.assign(number=rows["number"] + 10 * k) for k in range(20)])
    assert duel(many, B, A).verdict == "loses"
    assert duel(many, A, B).verdict == "wins"
    table = against(many, A)
    assert table.loc[B, "does alone"] == 0
    assert table.loc[B, f"{A} alone"] == 20
    assert table.loc[B, f"against {A}"] == "loses"


def test_halves_are_met_by_kind_and_on_all(rows):
    found = halves(rows)
    assert list(found) == ["random", "all"]
    assert (found["all"].first, found["all"].second) == (B, A)
    told = compared(found).loc["all"]
    assert (told["tasks"], told["best of the documents'"], told["best of today's"]) == (3, B, A)
    assert told["the documents' best"] == "undecided"
