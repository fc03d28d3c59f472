"""Completeness gate: nothing printed is skipped in silence.

``data/papers/inventory.csv`` lists what the documents contain, apart from the files that describe
it, so that an item deleted from a paper file is missed.
"""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from ..datafiles import data_path
from ..errors import DataFileError
from .registry import Registry


def read_inventory(path: Path | None = None) -> dict[str, str]:
    """Item ids of all documents with their kinds.

    Raises
    ------
    DataFileError
        The file is missing or has no columns ``id`` and ``kind``.
    """
    path = path or data_path("papers", "inventory.csv")
    try:
        table = pd.read_csv(path, dtype=str)
        return dict(zip(table["id"], table["kind"], strict=True))
    except (OSError, KeyError, ValueError) as error:
        raise DataFileError(path, "file", str(error), "a CSV with columns id and kind") from None


def gaps(registry: Registry, inventory: dict[str, str]) -> list[str]:
    """Every way in which the ledger is incomplete, one line each; empty when it is complete."""
    items, errata = registry.items, registry.errata
    found = [f"{i}: in the inventory, not in data/papers" for i in inventory if i not in items]
    found += [f"{i}: in data/papers, not in the inventory" for i in items if i not in inventory]
    found += [f"{i}: a checker for no item" for i in registry.checkers if i not in items]
    found += [f"{e}: a proof for no erratum" for e in registry.proofs if e not in errata]
    for item_id, item in items.items():
        if inventory.get(item_id, item.kind) != item.kind:
            found.append(f"{item_id}: kind is {item.kind}, the inventory says {inventory[item_id]}")
        if item_id not in registry.checkers and item.pending is None:
            found.append(f"{item_id}: neither a checker nor a declared reason")
        if item_id in registry.checkers and item.pending is not None:
            found.append(f"{item_id}: has a checker, but is still declared pending")
    for paper in registry.papers.values():
        found += [f"{claim}: no entry of sentences names it" for claim in paper.unsaid_claims]
    for erratum_id, erratum in errata.items():
        if (erratum_id in registry.proofs) == (erratum.no_proof is not None):
            found.append(f"{erratum_id}: needs either a proof or the reason why there is none")
    return found
