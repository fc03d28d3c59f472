"""Success of planners over the cells of a study: by the planner's own word, and in truth."""

from __future__ import annotations

from typing import Any

import pandas as pd

from ..ledger.shares import Share

FAILURES = ("displaced-goal", "midway-minimum")


def judged_share(table: pd.DataFrame, key: str, judged: str) -> Share:
    """Share of the cells in which column ``<key>_<judged>`` is true."""
    return Share.of(int(table[f"{key}_{judged}"].sum()), len(table))


def success_row(table: pd.DataFrame, key: str) -> dict[str, Any]:
    """Rates in percent from the columns ``<key>_planner`` and ``<key>_truth``, the 95 % interval of
    the true one, and how often it failed in which way where ``<key>_failure`` says so."""
    planner, truth = (judged_share(table, key, judged) for judged in ("planner", "truth"))
    row = {
        "planner %": round(100 * planner.value, 1),
        "true %": round(100 * truth.value, 1),
        "true low %": round(100 * truth.low, 1),
        "true high %": round(100 * truth.high, 1),
    }
    if f"{key}_failure" in table:
        counts = table[f"{key}_failure"].value_counts()
        row |= {kind: int(counts.get(kind, 0)) for kind in FAILURES}
    return row | {"of": len(table)}
