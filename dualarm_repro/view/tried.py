"""The figures of what was tried against the project, as stored: no sentence without its number."""

from __future__ import annotations

import json
from typing import Any

import pandas as pd

from ..datafiles import data_path
from .cell_table import table
from .page import Page

#: Columns of the table.
HEAD = ("tried", "number", "outcome")


def tried_page() -> Page:
    """How much was tried, by its kind, and how it ended; what did not survive by name."""
    found = _stored("tried")
    if found is None:
        return Page("<p>Nothing is stored; <code>make trust</code> runs it.</p>")
    return table(pd.DataFrame(found["rows"], columns=list(HEAD)))


def lost_page() -> Page:
    """The faults that something did not survive, with how often."""
    found = _stored("faults")
    if found is None:
        return Page("<p>No faults are stored.</p>")
    if not found["lost"]:
        number = sum(counts["tried"] for counts in found["counts"].values())
        return Page(f"<p>All {number} faults were survived.</p>")
    return table(pd.DataFrame(list(found["lost"].items()), columns=["lost", "times"]))


def otherwise_page() -> Page:
    """What came out otherwise when results were computed again in other circumstances."""
    found = _stored("determinism")
    if found is None:
        return Page("<p>Nothing computed again is stored.</p>")
    lines = [(name, line) for name, some in found["otherwise"].items() for line in some]
    if not lines:
        return Page(f"<p>Everything came out the same in {len(found['counts'])} circumstances.</p>")
    return table(pd.DataFrame(lines, columns=["circumstance", "came out otherwise"]))


def _stored(name: str) -> dict[str, Any] | None:
    path = data_path("results", f"{name}.json")
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None
