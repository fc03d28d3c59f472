"""What a computation hands to the ledger."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd

    from .captions import Caption


@dataclass(frozen=True)
class Result:
    """Outcome of one item.

    Attributes
    ----------
    obtained
        Numbers, texts, lists and mappings that the rules judge and that ``verify`` compares.
    measured
        Values that depend on the machine (times); shown, never compared.
    table
        The data behind the figure or table, exported as CSV.
    caption
        States the finding, with the obtained numbers in it; several sentences as a block of the
        template beside the page.
    alt
        Text for a reader who cannot see the figure.
    witnesses
        Examples from a stored study, with ``choice``, ``verdict`` (``holds`` or ``fails``) and
        ``values``: one for each side of a statement about a population that a sample leaves open,
        or a choice that shows a statement about one run to be possible.
    figure, scene
        Draw the figure (a matplotlib figure) or the 3-D scene (an object with ``html()``); called
        only when somebody looks.
    """

    obtained: dict[str, Any]
    caption: str | Caption
    measured: dict[str, Any] = field(default_factory=dict)
    table: pd.DataFrame | None = None
    alt: str | None = None
    figure: Callable[[], Any] | None = None
    scene: Callable[[], Any] | None = None
    witnesses: Sequence[Mapping[str, Any]] = ()

    def __post_init__(self) -> None:
        if self.figure is not None and not self.alt:
            raise ValueError("a figure needs alt text")

    def told(self) -> str:
        """The caption as text; its template knows every obtained and measured value by name."""
        if isinstance(self.caption, str):
            return self.caption
        return self.caption.told({**self.obtained, **self.measured})


@dataclass(frozen=True)
class Proof:
    """Proof of an erratum: a statement, whether the computation confirms it, the numbers."""

    statement: str
    holds: bool
    values: dict[str, Any] = field(default_factory=dict)


class Assumed(Mapping[str, Any]):
    """Values of a document's assumptions, with the names that a computation really read."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = dict(values)
        self.read: set[str] = set()

    def __getitem__(self, key: str) -> Any:
        value = self._values[key]
        self.read.add(key)
        return value

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)
