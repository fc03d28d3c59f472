"""Cells of a stored study as witnesses of a statement that they leave open: one for each side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from ...ledger import REGISTRY
from ...ledger.rules import Evidence, Outcome, Role


def witnesses(
    item_id: str,
    obtained: Mapping[str, Any],
    table: pd.DataFrame,
    holds: pd.Series,
    shown: Sequence[str],
) -> list[dict[str, Any]]:
    """The first cell in which the statement holds and the first in which it fails.

    None where a rule of the item fails, or where all hold: single cells then decide nothing.

    Parameters
    ----------
    shown
        Columns that tell the cell and what was found there.
    """
    thresholds = REGISTRY.look(item_id, "thresholds").thresholds
    evidence = Evidence(
        dict(obtained),
        REGISTRY.printed(item_id),
        {name: entry.value for name, entry in thresholds.items()},
    )
    rules = REGISTRY.checker(item_id).rules
    outcomes = {rule.outcome(evidence) for rule in rules if rule.role is Role.SUPPORTS}
    if Outcome.FAILS in outcomes or Outcome.OPEN not in outcomes:
        return []
    found = []
    for verdict, chosen in (("holds", holds), ("fails", ~holds)):
        rows = table[chosen.to_numpy(dtype=bool)]
        if len(rows):
            row = rows.iloc[0]
            values = {name: getattr(row[name], "item", lambda v=row[name]: v)() for name in shown}
            found.append({"choice": f"cell {rows.index[0]}", "verdict": verdict, "values": values})
    return found
