"""Witnesses of a statement that cases leave open: one for each side."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import pandas as pd

from .registry import REGISTRY
from .rules import Evidence, Outcome, Role


def one_for_each_side(
    cases: Iterable[tuple[str, bool, Mapping[str, Any]]],
) -> list[dict[str, Any]]:
    """The first case in which a statement holds and the first in which it fails, as far as there
    are such, from what was chosen, whether it holds, and the values found."""
    found: dict[bool, dict[str, Any]] = {}
    for choice, holds, values in cases:
        verdict = "holds" if holds else "fails"
        witness = {"choice": choice, "verdict": verdict, "values": dict(values)}
        found.setdefault(holds, witness)
    return [found[side] for side in (True, False) if side in found]


def is_open(item_id: str, obtained: Mapping[str, Any]) -> bool:
    """Whether a rule of the item is open and none fails: else single cases decide nothing."""
    thresholds = REGISTRY.look(item_id, "thresholds").thresholds
    bounds = {name: entry.value for name, entry in thresholds.items()}
    evidence = Evidence(dict(obtained), REGISTRY.printed(item_id), bounds)
    checker = REGISTRY.checker(item_id)
    rules = checker.rules if checker else ()
    outcomes = {rule.outcome(evidence) for rule in rules if rule.role is Role.SUPPORTS}
    return Outcome.OPEN in outcomes and Outcome.FAILS not in outcomes


def cell_witnesses(
    item_id: str,
    obtained: Mapping[str, Any],
    table: pd.DataFrame,
    holds: pd.Series,
    shown: Sequence[str],
) -> list[dict[str, Any]]:
    """Cells of a stored study as witnesses of an item that they leave open; none if they do not.

    Parameters
    ----------
    obtained
        What the rules of the item look at.
    holds
        Of each row of ``table``, whether the statement holds in that cell.
    shown
        Columns that tell the cell and what was found there.
    """
    if not is_open(item_id, obtained):
        return []
    rows = zip(table.iterrows(), holds.to_numpy(dtype=bool), strict=True)
    return one_for_each_side(
        (f"cell {index}", bool(held), {name: _plain(row[name]) for name in shown})
        for (index, row), held in rows
    )


def _plain(value: Any) -> Any:
    """A numpy scalar as a number of Python."""
    return value.item() if hasattr(value, "item") else value
