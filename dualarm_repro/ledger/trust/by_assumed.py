"""Change what was assumed: a judged value must move, and every draw must be computable."""

from __future__ import annotations

from ..registry import Registry
from ..robustness import NOT_COMPUTABLE, study_of
from .counts import Tally


def assumed(registry: Registry, item_id: str) -> Tally:
    """The changes and draws that are stored for an item; none are made anew."""
    study = study_of(registry, item_id)
    if study is None:
        return Tally()
    if (status := study.status()) != "up to date":
        stored = "not stored" if status == "missing" else status
        return Tally(open=(f"{item_id}: draws {stored}",))
    table = study.load()
    changes = table[table["kind"] == "change"]
    moves = [
        (f"{item_id}: nothing judged moves with {row['assumption']}", row["moves"] != "nothing")
        for _, row in changes.iterrows()
    ]
    draws = [
        (f"{item_id}: draw {index} cannot be computed", row["verdict"] != NOT_COMPUTABLE)
        for index, row in table[table["kind"] == "draw"].iterrows()
    ]
    return Tally.of([*moves, *draws])
