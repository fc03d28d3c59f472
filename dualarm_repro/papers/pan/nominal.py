"""The assumptions as they are declared in the ledger, for studies and drawings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ...ledger import REGISTRY


def nominal_values() -> dict[str, Any]:
    """Every assumption of the document with its declared value."""
    return REGISTRY.nominal("pan")


def plausible(key: str, share: float) -> Any:
    """The plausible value of an assumption at a share in [0, 1) of its range or choices."""
    return REGISTRY.declared(f"pan.{key}", "range", "choices").at(share)


def alternatives(key: str, count: int) -> list[Any]:
    """``count`` values over the range of an assumption, or all of its choices."""
    entry = REGISTRY.declared(f"pan.{key}", "range", "choices")
    if entry.range is not None:
        return [float(value) for value in np.linspace(*entry.range, count)]
    return list(entry.choices)


class Declared(Mapping[str, Any]):
    """Values, ranges and choices of some assumptions, read from the ledger when asked for.

    As settings of a study they make it stale when a value changes, but not when a sentence does.
    """

    def __init__(self, keys: tuple[str, ...]) -> None:
        self._keys = keys

    def __getitem__(self, key: str) -> Any:
        entry = REGISTRY.declared(f"pan.{key}", "value", "range", "choices")
        return {"value": entry.value, "range": entry.range, "choices": entry.choices}

    def __iter__(self) -> Iterator[str]:
        return iter(self._keys)

    def __len__(self) -> int:
        return len(self._keys)
