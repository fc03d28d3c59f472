"""Spot checks: a random share of what is stored is computed again and has to come out the same."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..sources import graph
from .registry import Registry
from .robustness import study_of
from .study import Study


class Spot(NamedTuple):
    """A study, how many of its cells were computed again, and what differs."""

    study: Study
    cells: int
    wrong: list[str]


def stored_studies(registry: Registry) -> dict[str, Study]:
    """Every stored study by name: those of the documents, then the robustness of their items."""
    found = dict(registry.studies)
    for item_id in registry.items:
        if study := study_of(registry, item_id):
            found[study.name] = study
    return found


def seed_of_code() -> int:
    """A seed that changes with the code, so that other cells are drawn after every change."""
    return int(graph().digest(graph().files)[:8], 16)


def spot_check(study: Study, cells: int, seed: int) -> Spot:
    """Compute some cells of a study again.

    Raises
    ------
    LedgerError
        The study is stale.
    """
    total = int(study.meta()["cells"])
    return Spot(study, min(cells, total), study.spot_check(cells, seed))


def spot_check_robustness(registry: Registry, count: int, seed: int) -> list[Spot]:
    """Compute one draw again in each of ``count`` items that rest on assumptions."""
    studies: list[Any] = [study_of(registry, item_id) for item_id in registry.items]
    drawn = [study for study in studies if study and study.cells()[0]["kind"] == "draw"]
    rng = np.random.default_rng(seed)
    chosen = rng.choice(len(drawn), min(count, len(drawn)), replace=False)
    return [Spot(drawn[k], 1, drawn[k].spot_check(1, seed, kind="draw")) for k in sorted(chosen)]
