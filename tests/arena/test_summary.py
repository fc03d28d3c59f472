"""Tables of the arena, from rows whose answer is counted by hand."""

import contest_rows
import numpy as np
import pytest
from contest_rows import A, B

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
