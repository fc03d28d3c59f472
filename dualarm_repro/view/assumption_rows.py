"""Assumptions of an item as rows of its card: those that move the outcome most come first."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..ledger.changed import flipping, setting
from .numbers import number, words

_EVIDENCE = {
    "printed": "printed elsewhere in the document",
    "public": "published by others",
    "inferred": "inferred from what is printed",
    "assumed": "assumed",
}


@dataclass(frozen=True)
class Row:
    """One assumption: what it says, its value, what else is plausible, how much hangs on it."""

    id: str
    statement: str
    value: str
    plausible: str
    influence: float
    flip: str
    why: str
    evidence: str

    @property
    def moves(self) -> bool:
        """Whether something hangs on it."""
        return bool(self.influence or self.flip)


def assumption_rows(made: Mapping[str, Any]) -> list[Row]:
    """Rows of a record, by influence."""
    found = made["robustness"] or {"influence": {}, "flip": None}
    rows = [_row(entry, found) for entry in made["assumptions"]]
    return sorted(rows, key=lambda row: (-row.influence, not row.flip))


def context_rows(made: Mapping[str, Any]) -> list[Row]:
    """Rows of what is read but can move no judged value."""
    return [_row(entry, {"influence": {}, "flip": None}) for entry in made["context"]]


def rerun(made: Mapping[str, Any]) -> tuple[str, str] | None:
    """A command that computes the item with one assumption changed, and what it is to show.

    The change that alone flips the outcome, or else another plausible value of the assumption that
    moves it most; None for an item whose assumptions have no other value.
    """
    if change := flipping(made):
        return f"dualarm run {made['id']} --set {change}", "with the choice that flips it"
    influence = (made["robustness"] or {}).get("influence", {})
    for entry in sorted(made["assumptions"], key=lambda one: -influence.get(one["id"], 0.0)):
        if (other := _another(entry)) is not None:
            change = setting(entry["id"], other)
            return f"dualarm run {made['id']} --set {change}", "with an assumption changed"
    return None


def _another(entry: Mapping[str, Any]) -> Any:
    """A plausible value that is not the declared one: of a range the end that lies farther off."""
    value = entry["value"]
    if entry.get("range") and isinstance(value, int | float):
        return max(entry["range"], key=lambda end: abs(end - value))
    others = [one for one in entry.get("choices") or [] if one != value]
    simple = [one for one in others if not isinstance(one, list | dict)]
    return simple[0] if simple else None


def _row(entry: Mapping[str, Any], found: Mapping[str, Any]) -> Row:
    unit, flip = entry.get("unit", ""), found["flip"]
    flips = ""
    if flip and flip["assumption"] == entry["id"]:
        flips = f"alone flips the outcome at {words(flip['value'], unit)}"
    return Row(
        id=entry["id"],
        statement=entry["statement"],
        value=words(entry["value"], unit),
        plausible=_plausible(entry, unit),
        influence=found["influence"].get(entry["id"], 0.0),
        flip=flips,
        why=entry["why"],
        evidence=_EVIDENCE.get(entry["evidence"], entry["evidence"]),
    )


def _plausible(entry: Mapping[str, Any], unit: str) -> str:
    if entry.get("range"):
        low, high = entry["range"]
        return f"{number(low)} to {number(high)} {unit}".rstrip()
    others = [one for one in entry.get("choices") or [] if one != entry["value"]]
    return "or " + ", ".join(words(one, unit) for one in others) if others else ""
