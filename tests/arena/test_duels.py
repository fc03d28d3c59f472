"""Duels of the arena, from rows whose answer is counted by hand."""

import contest_rows
import numpy as np
import pandas as pd
import pytest
from contest_rows import A, B
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq
from scipy.stats import norm

from dualarm_repro.arena.duels import (
    Duel,
    against,
    compared,
    duel,
    halves,
    paired_difference,
    successes,
)
from dualarm_repro.arena.summary import contest
from dualarm_repro.ledger.shares import Share


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


def wilson_ends(count, total):
    """Both solutions p of |p - count / total| = z sqrt(p (1 - p) / total), sought by bisection."""
    z, share = norm.ppf(0.975), count / total

    def off(p):
        return abs(p - share) - z * np.sqrt(p * (1.0 - p) / total)

    low = brentq(off, 0.0, min(share, 1.0 - 1e-9), xtol=1e-14) if share > 0.0 else 0.0
    high = brentq(off, max(share, 1e-9), 1.0, xtol=1e-14) if share < 1.0 else 1.0
    return low, high


@settings(max_examples=50)
@given(*[st.integers(0, 30)] * 4)
def test_interval_by_another_way(both, first, second, neither):
    """Wilson's ends by bisection, the correlation by numpy, joined as the cosine rule has it."""
    assume(both + first + second + neither > 0)
    a, b = outcomes(both, first, second, neither)
    found = paired_difference(a, b)
    (p_low, p_high), (q_low, q_high) = (wilson_ends(x.sum(), len(x)) for x in (a, b))
    p, q = a.mean(), b.mean()
    steady = a.std() == 0.0 or b.std() == 0.0
    phi = 0.0 if steady else np.corrcoef(a, b)[0, 1]

    def third_side(x, y):
        return np.sqrt(max(x**2 + y**2 - 2.0 * phi * x * y, 0.0))

    # where the sides nearly cancel, the root halves the digits of their difference
    assert found.value == pytest.approx(p - q, abs=1e-12)
    assert found.low == pytest.approx(p - q - third_side(p - p_low, q_high - q), abs=1e-6)
    assert found.high == pytest.approx(p - q + third_side(q - q_low, p_high - p), abs=1e-6)
    assert -1.0 - 1e-9 <= found.low <= found.value <= found.high <= 1.0 + 1e-9


@settings(max_examples=20)
@given(*[st.integers(0, 20)] * 4)
def test_equal_outcomes_have_no_difference(both, first, second, neither):
    """Of a method with itself the correlation is one, so that equal margins cancel."""
    assume(both + first + second + neither > 0)
    a, _ = outcomes(both, first, second, neither)
    found = paired_difference(a, a)
    assert found.value == 0.0
    assert found.low <= 0.0 <= found.high
    assert found.high == pytest.approx(-found.low)


@pytest.mark.parametrize(
    ("low", "high", "verdict"),
    [(0.01, 0.3, "wins"), (-0.3, -0.01, "loses"), (-0.1, 0.2, "undecided"), (0.0, 0.2, "undecided"),
     (-0.2, 0.0, "undecided")],
)  # fmt: skip
def test_a_duel_is_decided_by_its_whole_interval(low, high, verdict):
    shares = Share.of(3, 4), Share.of(1, 4)
    made = Duel(A, B, 4, 2, 0, shares, Share(0.5 * (low + high), low, high))
    assert made.verdict == verdict


def test_a_duel_is_told_with_signs():
    made = Duel(A, B, 4, 2, 0, (Share.of(3, 4),) * 2, Share(0.125, -0.031, 0.28))
    assert made.told == "+12% [-3%, +28%]"


def test_tasks_of_a_method_that_did_not_run_are_not_done(rows):
    missing = rows[~((rows["method"] == A) & (rows["number"] == 0))]
    assert successes(missing)[A].tolist() == [False, True, False]
