"""Cells of a stored study as witnesses of a statement about all of them: one for each side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pandas as pd


def witnesses(table: pd.DataFrame, holds: pd.Series, shown: Sequence[str]) -> list[dict[str, Any]]:
    """The first cell in which the statement holds and the first in which it fails.

    Parameters
    ----------
    shown
        Columns that tell the cell and what was found there.
    """
    found = []
    for verdict, chosen in (("holds", holds), ("fails", ~holds)):
        rows = table[chosen.to_numpy(dtype=bool)]
        if len(rows):
            row = rows.iloc[0]
            values = {name: getattr(row[name], "item", lambda v=row[name]: v)() for name in shown}
            found.append({"choice": f"cell {rows.index[0]}", "verdict": verdict, "values": values})
    return found
