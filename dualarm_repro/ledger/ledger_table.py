"""The ledger as one table: a row an item, nested values as JSON texts."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .files import to_json

if TYPE_CHECKING:
    import pandas as pd

#: Fields of a record that are columns as they are.
PLAIN = ("id", "paper", "kind", "title", "place", "role", "unit", "verdict", "change", "page")
#: Fields that hold lists and mappings.
NESTED = ("printed", "obtained", "measured", "checks", "witnesses", "code")
#: Lists of which the table holds the ids or texts, one a line.
LISTS = ("assumptions", "errata", "missing")


def ledger_table(records: Iterable[dict[str, Any]]) -> pd.DataFrame:
    """One row a record; a field that a record does not have is empty.

    Returns
    -------
    DataFrame
        Texts, but for the numbers ``holds``, ``holds_low``, ``holds_high`` and ``samples`` of the
        robustness.
    """
    import pandas as pd

    rows = [_row(made) for made in records]
    texts = [*PLAIN, *NESTED, *LISTS, "caption"]
    numbers = ["holds", "holds_low", "holds_high", "samples"]
    table = pd.DataFrame(rows, columns=[*texts, *numbers])
    types = dict.fromkeys(texts, "string") | dict.fromkeys(numbers[:3], "Float64")
    return table.astype({**types, "samples": "Int64"})


def _row(made: dict[str, Any]) -> dict[str, Any]:
    row = {name: made.get(name) for name in (*PLAIN, "caption")}
    for name in NESTED:
        value = made.get(name)
        row[name] = None if value is None else to_json(value, indent=None).rstrip("\n")
    for name in LISTS:
        entries = made.get(name) or []
        texts = [entry["id"] if isinstance(entry, dict) else str(entry) for entry in entries]
        row[name] = "\n".join(texts) or None
    robust = made.get("robustness") or {}
    low, high = robust.get("interval") or (None, None)
    return row | {
        "holds": robust.get("holds"),
        "holds_low": low,
        "holds_high": high,
        "samples": robust.get("samples"),
    }
