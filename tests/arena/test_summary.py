"""Tables of the arena, from rows whose answer is counted by hand."""

import contest_rows
import numpy as np
import pandas as pd
import pytest
from contest_rows import A, B
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arena.cases import KINDS
from dualarm_repro.arena.judged import Outcome
from dualarm_repro.arena.study import ARENA, CONTESTANTS, EVALUATIONS, PAPERS, WITNESS
from dualarm_repro.arena.summary import (
    CLOCK,
    SHIFT,
    by_group,
    contest,
    effort,
    lost_tasks,
    methods_of,
    outcome_counts,
    profile,
    success_table,
)
from dualarm_repro.baselines import BASELINES
from dualarm_repro.baselines.registry import WHOLE_LINKS
from dualarm_repro.cli.arena import KINDS as TOLD
from dualarm_repro.ledger.shares import Share
from dualarm_repro.planning import METHODS


@pytest.fixture
def table():
    return contest_rows.table()


def test_success_counts_feasible_tasks_only(table):
    found = success_table(contest(table))
    assert found["tasks"].tolist() == [3, 3]
    assert found.loc[A, ["share", "low", "high"]].tolist() == list(Share.of(2, 3))
    assert found.loc[B, "share"] == pytest.approx(1 / 3)
    assert found.loc[B, "claimed"] == pytest.approx(2 / 3)


def test_outcomes_are_all_there(table):
    found = outcome_counts(contest(table))
    assert (found.sum(axis=1) == 4).all()
    assert found.loc[B, str(Outcome.COLLIDES)] == 2
    assert found.loc[A, str(Outcome.REFUSED)] == 0


def test_profile_counts_failures_as_never(table):
    """On task 1 the path of B is shorter, but it collides and is no measure for the best."""
    found = profile(contest(table), "joint_length", np.array([1.0, 2.9, 3.0]))
    assert found[A].tolist() == pytest.approx([2 / 3, 2 / 3, 2 / 3])
    assert found[B].tolist() == pytest.approx([0.0, 0.0, 1 / 3])


def test_effort_counts_a_failure_as_all_evaluations(table):
    found = effort(contest(table))
    spent = np.array([100.0, 300.0, 20_000.0])
    right = np.exp(np.log(spent + SHIFT).mean()) - SHIFT
    assert found.loc[A, "evaluations"] == pytest.approx(right)
    spent = np.array([50.0, EVALUATIONS, EVALUATIONS])
    assert found.loc[B, "evaluations"] == pytest.approx(
        np.exp(np.log(spent + SHIFT).mean()) - SHIFT
    )
    clock = found.loc[A, list(CLOCK)]
    assert clock.tolist() == pytest.approx([2.0, 3.0, 101.5])  # of 1, 3 and 200 s
    assert (found["low"] <= found["evaluations"]).all()
    assert (found["evaluations"] <= found["high"]).all()


def test_groups_and_tasks_that_are_counted_apart(table):
    assert by_group(contest(table), "random", [A]).loc[A, "g"] == "2 of 3"
    lost = lost_tasks(table).loc["random"]
    assert lost.to_dict() == {"tasks": 5, "unsound ends": 1, "no witness": 1}


def test_every_method_of_the_library_is_a_contestant():
    documents = [name for name in METHODS if name not in {*BASELINES, WHOLE_LINKS}]
    assert (*documents, WHOLE_LINKS) == PAPERS
    assert set(CONTESTANTS) == {*PAPERS, *BASELINES}
    assert TOLD == KINDS
    assert {cell["method"] for cell in ARENA.cells()} == {WITNESS, *CONTESTANTS}


def test_a_task_is_feasible_if_anybody_can_do_it(table):
    rows = contest(table)
    told = rows.groupby("number")["feasible"].first()
    assert told.to_dict() == {0: True, 1: True, 2: True, 3: False}
    assert WITNESS not in set(rows["method"])
    assert 4 not in set(rows["number"])
    unseen = table[table["method"] != WITNESS]
    assert contest(unseen).groupby("number")["feasible"].first()[2] == np.False_


def test_methods_come_in_the_order_of_the_list_and_strangers_last(table):
    stranger = table[table["method"] == A].assign(method="my own")
    rows = contest(pd.concat([stranger, table]))
    assert methods_of(rows) == [B, A, "my own"], "the documents' come first"
    assert success_table(rows).loc["my own", "share"] == success_table(rows).loc[A, "share"]


@settings(max_examples=20)
@given(st.floats(1e-3, 1e3), st.integers(0, 3))
def test_a_profile_does_not_know_the_unit_of_a_task(factor, number):
    """Ratios to the best of a task stay, whatever is the length of the task."""
    rows = contest(contest_rows.table())
    scaled = rows.copy()
    mine = scaled["number"] == number
    scaled.loc[mine, "joint_length"] *= factor
    ratios = np.array([1.0, 1.7, 2.9, 3.1])
    pd.testing.assert_frame_equal(
        profile(rows, "joint_length", ratios), profile(scaled, "joint_length", ratios)
    )


@settings(max_examples=20)
@given(st.lists(st.tuples(st.booleans(), st.integers(0, 20_000)), min_size=1, max_size=12))
def test_effort_lies_between_its_runs_and_grows_with_them(runs):
    rows = [
        contest_rows.made(k, A, Outcome.SUCCESS if done else Outcome.STOPPED, 1.0, count)
        for k, (done, count) in enumerate(runs)
    ]
    rows += [contest_rows.made(k, WITNESS, Outcome.SUCCESS) for k in range(len(runs))]
    found = effort(contest(pd.DataFrame(rows))).loc[A]
    spent = [count if done else max(count, EVALUATIONS) for done, count in runs]
    assert min(spent) - 1e-6 <= found["low"] <= found["evaluations"] + 1e-6
    assert found["evaluations"] <= found["high"] + 1e-6 <= max(spent) + 1e-5
    mean = np.mean(spent)
    assert found["evaluations"] <= mean + 1e-6, "a geometric mean is below the plain one"


def test_a_failure_that_took_more_keeps_its_own(table):
    """A has 20 000 evaluations on task 2, which it does not do; a limit of 50 changes nothing."""
    small, usual = (
        effort(contest(table), most).loc[A, "evaluations"] for most in (50, EVALUATIONS)
    )
    assert small == pytest.approx(usual)
    assert effort(contest(table), 50).loc[B, "evaluations"] < 200.0


def test_a_group_without_feasible_tasks_is_told_as_such(table):
    lost = table[table["number"] == 3].assign(group="hard")
    rows = contest(pd.concat([table, lost]))
    found = by_group(rows, "random", [A, B])
    assert found.loc[A].to_dict() == {"g": "2 of 3", "hard": "0 of 0"}
    assert found.loc[B].to_dict() == {"g": "1 of 3", "hard": "0 of 0"}
    assert by_group(rows, "document", [A]).empty


def test_lost_tasks_are_counted_by_kind(table):
    other = table.assign(kind="document")
    found = lost_tasks(pd.concat([table, other[other["number"] == 4]]))
    assert found.loc["document"].to_dict() == {"tasks": 1, "unsound ends": 1, "no witness": 0}
    assert found.loc["random"].to_dict() == {"tasks": 5, "unsound ends": 1, "no witness": 1}
    assert found.index.name == "kind"


def test_a_method_without_feasible_tasks_has_no_share(table):
    only = table[table["number"] == 3]
    found = success_table(contest(only)).loc[A]
    assert found["tasks"] == 0
    assert np.isnan(found["share"])
    assert (found["low"], found["high"]) == (0.0, 1.0)
    assert np.isnan(found["claimed"])
