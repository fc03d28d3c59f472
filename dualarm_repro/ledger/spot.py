"""Spot checks: a random share of what is stored is computed again and has to come out the same."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ..errors import InputError
from ..sources import graph
from ..tracking import recording
from .drift import differences
from .files import through_json
from .registry import Registry
from .robustness import study_of
from .round_off import moved_by_round_off, path_of
from .study import Study


class Spot(NamedTuple):
    """A study, how many of its cells were computed again, and what differs.

    ``unsettled`` are values that differ, and that round-off of the inputs moves as well.
    """

    study: Study
    cells: int
    wrong: list[str]
    unsettled: list[str]


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


def spot_check(study: Study, count: int, seed: int, kind: str | None = None) -> Spot:
    """Compute ``count`` cells of a study, drawn with ``seed``, again and compare with the store.

    Parameters
    ----------
    kind
        Draw among the cells of this ``kind`` only.

    Raises
    ------
    LedgerError
        The study is stale.
    """
    if count < 1:
        raise InputError("spot check", "count", count, "a positive number")
    table, cells, known = study.load(), study.cells(), study.meta()["inputs"].keys()
    edge = table[study.knife_edge] if study.knife_edge else [False] * len(cells)
    among = [
        k
        for k, cell in enumerate(cells)
        if kind in (None, cell.get("kind")) and not (edge[k] is True or edge[k] == 1)
    ]
    drawn = np.random.default_rng(seed).choice(among, min(count, len(among)), replace=False)
    spot = Spot(study, len(drawn), [], [])
    for index in sorted(int(k) for k in drawn):
        with recording() as inputs:
            made = study.cell(index, cells[index])
        title = f"{study.name} cell {index}: "
        spot.wrong.extend(f"{title}opened {name}, which is not recorded" for name in inputs - known)
        if study.knife_edge and made.get(study.knife_edge):  # here, if not where it was stored
            continue
        stored = table.iloc[index].drop(cells[index].keys() - made.keys()).to_dict()
        lines = study.differs(stored, made)
        moved = moved_by_round_off(study, index, cells[index], made, [*map(path_of, lines)])
        for line in lines:
            (spot.unsettled if path_of(line) in moved else spot.wrong).append(title + line)
        spot.wrong.extend(title + line for line in _uncertified(study, cells[index], stored))
    return spot


def _uncertified(study: Study, settings: Mapping[str, Any], stored: Mapping[str, Any]) -> list[str]:
    """What of a stored row does not follow from the rest of it."""
    if study.certificate is None:
        return []
    again, row = through_json(study.certificate(settings, stored)), study.plain(stored)
    kept = {key: row.get(key) for key in again}
    return differences({"obtained": kept}, {"obtained": again}, study.compared)


def spot_check_robustness(registry: Registry, count: int, seed: int) -> list[Spot]:
    """Compute one draw again in each of ``count`` items that rest on assumptions."""
    studies: list[Any] = [study_of(registry, item_id) for item_id in registry.items]
    drawn = [study for study in studies if study and study.cells()[0]["kind"] == "draw"]
    rng = np.random.default_rng(seed)
    chosen = rng.choice(len(drawn), min(count, len(drawn)), replace=False)
    return [spot_check(drawn[k], 1, seed, kind="draw") for k in sorted(chosen)]
