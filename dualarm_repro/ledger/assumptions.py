"""Assumptions of a document as the frozen settings of its methods and studies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import Any, Self

import numpy as np

from .registry import REGISTRY


class FromAssumptions:
    """A frozen dataclass, which can be memoised, whose fields are assumptions of those names."""

    @classmethod
    def of(cls, assumed: Mapping[str, Any]) -> Self:
        """Read exactly the fields from the assumptions."""
        return cls(**{field.name: hashable(assumed[field.name]) for field in fields(cls)})  # type: ignore[arg-type]

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """The assumptions that are read."""
        return tuple(field.name for field in fields(cls))  # type: ignore[arg-type]


def hashable(value: Any) -> Any:
    """A value of the YAML with its lists as tuples, and its mappings as sorted pairs."""
    if isinstance(value, Mapping):
        return tuple(sorted((key, hashable(part)) for key, part in value.items()))
    return tuple(hashable(part) for part in value) if isinstance(value, list) else value


def plausible(name: str, share: float) -> Any:
    """Value of ``<document>.<assumption>`` at a share in [0, 1) of its range or choices."""
    return REGISTRY.declared(name, "range", "choices").at(share)


def alternatives(name: str, count: int) -> list[Any]:
    """``count`` values over the range of ``<document>.<assumption>``, or all of its choices."""
    entry = REGISTRY.declared(name, "range", "choices")
    if entry.range is not None:
        return [float(value) for value in np.linspace(*entry.range, count)]
    return list(entry.choices or ())


class Chosen(Mapping[str, Any]):
    """Values of assumptions of a document, and further settings; all are read when asked for.

    As settings of a study they make it stale when a value changes, but not when a sentence does.

    Parameters
    ----------
    document
        Its id.
    names
        Of the assumptions.
    ranges
        Whether their ranges and choices count, too, as where a study draws from them.
    further
        Settings that are no assumptions, or that take the place of one.
    """

    def __init__(
        self, document: str, names: tuple[str, ...], *, ranges: bool = False, **further: Any
    ) -> None:
        self._document, self._ranges, self._further = document, ranges, further
        self._names = tuple(name for name in names if name not in further)

    def __getitem__(self, key: str) -> Any:
        if key in self._further:
            return self._further[key]
        if key not in self._names:
            raise KeyError(key)
        name = f"{self._document}.{key}"
        if not self._ranges:
            return REGISTRY.assumption(name)
        entry = REGISTRY.declared(name, "value", "range", "choices")
        return {"value": entry.value, "range": entry.range, "choices": entry.choices}

    def __iter__(self) -> Iterator[str]:
        return iter((*self._names, *self._further))

    def __len__(self) -> int:
        return len(self._names) + len(self._further)
