"""A contest that is run now: the first tasks of a kind, each with its own stream."""

import numpy as np
import pytest

from dualarm_repro.arena import contest as module
from dualarm_repro.arena.cases import NEAR, RANDOM, case_of, case_settings
from dualarm_repro.arena.contest import contest_now
from dualarm_repro.arena.judged import Outcome, judged_row
from dualarm_repro.arena.study import EVALUATIONS, SEED, known
from dualarm_repro.arena.summary import success_table
from dualarm_repro.errors import UnknownNameError
from dualarm_repro.ledger.streams import stream


def test_a_row_is_that_of_the_judge():
    table = contest_now(["attraction-only"], kind=RANDOM, most=1, evaluations=200)
    (settings,) = [one for one in case_settings() if one["kind"] == RANDOM][:1]
    alone = judged_row(case_of(settings), known("attraction-only"), 200, stream(SEED, 0))
    (row,) = table.to_dict("records")
    assert {key: row[key] for key in settings} == settings
    for key in ("outcome", "lower", "upper", "joint_length", "evaluations", "reason"):
        assert row[key] == alone[key], key
    assert row["feasible"] is True or row["feasible"] == np.True_
    assert row["success"] == (row["outcome"] == Outcome.SUCCESS)


@pytest.fixture
def quick(monkeypatch):
    """Runs that take no time; the second task is none."""
    asked = []

    def judged(case, method, evaluations, rng):
        asked.append((case["number"], method.name, evaluations, float(rng.random())))
        ends = {0: Outcome.SUCCESS, 1: Outcome.NO_TASK}
        return {"outcome": str(ends.get(case["number"], Outcome.STOPPED)), "claim": True}

    monkeypatch.setattr(module, "judged_row", judged)
    monkeypatch.setattr(module, "case_of", dict)
    return asked


def test_tasks_that_are_none_are_left_out_and_all_others_count(quick):
    table = contest_now(["rrt-connect", "apf-improved"], kind=RANDOM, most=3)
    assert table["number"].tolist() == [0, 2, 0, 2]
    assert table["method"].tolist() == ["rrt-connect"] * 2 + ["apf-improved"] * 2
    assert table["success"].tolist() == [True, False] * 2
    assert table["feasible"].all()
    assert {one[2] for one in quick} == {EVALUATIONS}
    found = success_table(table)
    assert found.loc["rrt-connect", "share"] == 0.5
    assert found.loc["rrt-connect", "claimed"] == 1.0


def test_every_method_gets_the_same_numbers_on_a_task(quick):
    contest_now(["rrt-connect", "apf-improved"], kind=NEAR, most=4)
    drawn = {}
    for number, name, _, value in quick:
        drawn.setdefault(name, []).append((number, value))
    assert drawn["rrt-connect"] == drawn["apf-improved"]
    values = [value for _, value in drawn["rrt-connect"]]
    assert len(set(values)) == len(values) == 4
    assert values == [float(stream(SEED, k).random()) for k in range(4)]


def test_all_kinds_are_met_unless_one_is_named(quick):
    contest_now(["rrt-connect"])
    assert len(quick) == len(case_settings())


def test_progress_is_told_by_method(quick):
    told = []

    def each(items, what):
        told.append((list(items), what))
        return items

    contest_now(["rrt-connect", "apf-improved"], most=1, each=each)
    assert told == [(["rrt-connect", "apf-improved"], "arena")]


def test_an_unknown_method_is_refused_before_anything_is_run(quick):
    with pytest.raises(UnknownNameError, match="nobody"):
        contest_now(["rrt-connect", "nobody"])
    assert quick == []
