"""Assumption values as the frozen settings of a study, read when they are needed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import Any

from ...ledger import REGISTRY
from .layout import Layout
from .methods import Method
from .motions import Case, Encounter

CASE = tuple(field.name for part in (Layout, Method, Encounter) for field in fields(part))
#: What a random arrangement keeps of the assumptions: all but the place of bases and window.
KEPT = tuple(
    name
    for name in CASE
    if not name.startswith(
        (
            "master_base_",
            "base_distance",
            "window_centre",
            "window_normal",
            "window_opening",
            "window_bar",
        )
    )
)


class Chosen(Mapping[str, Any]):
    """Values of assumptions by name, and further settings; all are read when asked for."""

    def __init__(self, names: tuple[str, ...], **further: Any) -> None:
        self._names, self._further = names, further

    def __getitem__(self, key: str) -> Any:
        return self._further[key] if key in self._further else assumption(key)

    def __iter__(self) -> Iterator[str]:
        return iter((*self._names, *self._further))

    def __len__(self) -> int:
        return len(self._names) + len(self._further)


def assumption(name: str) -> Any:
    """The value of an assumption of the document."""
    return REGISTRY.assumption(f"xue.{name}")


def nominal() -> Case:
    """The case of the assumptions as they stand."""
    return Case.of({name: assumption(name) for name in CASE})
