"""Cells of the arena: who runs on them, and when the witness stops looking."""

import numpy as np
import pytest

from dualarm_repro.arena import study
from dualarm_repro.arena.cases import case_settings
from dualarm_repro.arena.judged import Outcome
from dualarm_repro.errors import UnknownNameError
from dualarm_repro.planning.planner import PlannerSettings

RNG = np.random.default_rng(0)


@pytest.fixture
def runs(monkeypatch):
    """Outcomes that a run has in turn, and what was run."""
    ahead, asked = [], []

    def judged(case, method, evaluations, rng):
        asked.append((case, method, evaluations))
        return {"outcome": str(ahead.pop(0)), "run": len(asked)}

    monkeypatch.setattr(study, "judged_row", judged)
    return ahead, asked


@pytest.mark.parametrize(
    ("outcomes", "count"),
    [
        ((Outcome.SUCCESS,), 1),
        ((Outcome.NO_TASK,), 1),
        ((Outcome.STOPPED, Outcome.SUCCESS), 2),
        ((Outcome.COLLIDES, Outcome.STOPPED, Outcome.SUCCESS), 3),
        ((Outcome.STOPPED,) * 3, 3),
    ],
)
def test_the_witness_runs_until_somebody_arrives(runs, outcomes, count):
    ahead, asked = runs
    ahead += outcomes
    row = study.witness("a case", RNG)
    assert len(asked) == count == row["run"]
    assert row["outcome"] == str(outcomes[-1])
    assert {one[2] for one in asked} == {study.WITNESS_EVALUATIONS}
    assert {one[1].name for one in asked} == {study.BEST}


def test_a_cell_runs_its_method_on_its_case(runs, monkeypatch):
    ahead, asked = runs
    ahead += [Outcome.STOPPED] * 5
    monkeypatch.setattr(study, "case_of", lambda settings: settings["subject"])
    cell = {"kind": "random", "group": "g", "subject": "s", "number": 0, "method": "rrt-connect"}
    study.arena_cell(cell, RNG)
    assert (asked[0][0], asked[0][1].name, asked[0][2]) == ("s", "rrt-connect", study.EVALUATIONS)
    study.arena_cell({**cell, "method": study.WITNESS}, RNG)
    assert len(asked) == 1 + study.WITNESS_RUNS


def test_every_case_meets_every_contestant_and_the_witness():
    cells = study.arena_cells()
    count = len(case_settings())
    assert len(cells) == count * (1 + len(study.CONTESTANTS))
    assert sum(cell["method"] == study.WITNESS for cell in cells) == count
    assert len({tuple(cell.values()) for cell in cells}) == len(cells)


def test_a_method_that_is_not_known_is_named_with_those_that_are():
    with pytest.raises(UnknownNameError) as caught:
        study.known("nobody")
    text = str(caught.value)
    assert text.startswith("arena: method = 'nobody': expected one of ")
    assert "rrt-connect" in text
    assert study.known("rrt-connect").name == "rrt-connect"


def test_the_time_of_the_processor_is_no_part_of_the_result():
    row = {"outcome": "x", "lower": 1.0, "time": 1.0}
    assert study.ARENA.differs(row, {**row, "time": 9.0}) == []
    assert study.ARENA.differs(row, {**row, "lower": 1.1}) != []


def test_a_planner_may_ask_by_default_for_what_shows_that_a_task_can_be_done():
    assert PlannerSettings().evaluations == study.WITNESS_EVALUATIONS
