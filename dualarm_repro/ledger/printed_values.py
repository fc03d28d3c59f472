"""Numbers that items print, under names of their own."""

from __future__ import annotations

from typing import Any

import numpy as np

from .registry import REGISTRY


def printed_numbers(item_id: str, *keys: str) -> np.ndarray:
    """What an item prints under one key, or under each of several keys, one row for each."""
    found = REGISTRY.printed(item_id)
    rows = np.array([found[key] for key in keys], dtype=float)
    return rows[0] if len(keys) == 1 else rows


class PrintedValue:
    """Attribute of a class that is read from the ledger whenever it is asked for: a number, or an
    array of :func:`printed_numbers`."""

    def __init__(self, item_id: str, *keys: str) -> None:
        self._item_id, self._keys = item_id, keys

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        found = printed_numbers(self._item_id, *self._keys)
        return found if np.ndim(found) else float(found)
