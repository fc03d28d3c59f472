"""The stored study of the arena, and runs of it that are not stored."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..baselines.registry import BASELINES, WHOLE_LINKS, enlist
from ..errors import UnknownNameError
from ..ledger.study import Study
from .case import Case
from .cases import case_of, cells
from .judged import MEASURED, Outcome, judged_row

#: Configurations that a planner may ask distances of, and those of the witness.
EVALUATIONS, WITNESS_EVALUATIONS = 10_000, 20_000
#: A method of this name asks whether a task can be done at all.
WITNESS, BEST, WITNESS_RUNS = "witness", "rrt-connect-simplified", 3
SEED = 20_260_015
#: Methods of the documents.
PAPERS = (
    "apf-improved", "apf-traditional", "apf-traditional-points", "apf-cartesian-ik",
    "attraction-only", "apf-bidirectional", "apf-one-sided", WHOLE_LINKS,
)  # fmt: skip
#: Every method of the stored study.
CONTESTANTS = (*PAPERS, *BASELINES)


def arena_cells() -> list[dict[str, Any]]:
    """A cell for every case and contestant, and one for its witness."""
    return cells((WITNESS, *CONTESTANTS))


def arena_cell(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """One method on one case."""
    case = case_of(settings)
    if settings["method"] == WITNESS:
        return witness(case, rng)
    return judged_row(case, known(settings["method"]), EVALUATIONS, rng)


def witness(case: Case, rng: np.random.Generator) -> dict[str, Any]:
    """The row of long runs of the best planner, until one is certified free of contact."""
    row: dict[str, Any] = {}
    for _ in range(WITNESS_RUNS):
        row = judged_row(case, known(BEST), WITNESS_EVALUATIONS, rng)
        if row["outcome"] in (Outcome.SUCCESS, Outcome.NO_TASK):
            break
    return row


def known(name: str) -> Any:
    """The method of a name, of another package too.

    Raises
    ------
    UnknownNameError
        There is none.
    """
    listed = enlist()
    if name not in listed:
        raise UnknownNameError("arena", "method", name, f"one of {', '.join(listed)}")
    return listed[name]


ARENA = Study(
    name="arena",
    title="Every planner on the same tasks, judged by the certified distance of whole links",
    cells=arena_cells,
    compute=arena_cell,
    seed=SEED,
    settings={"evaluations": EVALUATIONS, "witness_evaluations": WITNESS_EVALUATIONS},
    measured=MEASURED,
    peers={"ompl": "ompl", "pink": "pink", "crocoddyl": "crocoddyl"},
)
