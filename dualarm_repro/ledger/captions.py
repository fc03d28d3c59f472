"""Captions of several sentences: blocks of a template beside the page, filled when they are read.

A caption states a finding with the computed numbers in it. It is filled when the record is made,
not while an item is computed, so that another wording makes no stored study stale.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from jinja2 import Environment, StrictUndefined, Template, TemplateError

from ..errors import LedgerError
from ..sources import ROOT
from ..tracking import note

_PACKAGE = Path(__file__).resolve().parents[1]


@dataclass(frozen=True)
class Caption:
    """A block of a template, and values for it beside those that the result gives.

    Blocks are filled alone: macros and ``{% set %}`` stand inside the block that uses them, and a
    sentence of several blocks is one of its own, ``{{ self.name() }}``.

    Attributes
    ----------
    path
        The template, ``<page>.j2`` beside ``<page>.py``.
    block
        Name of the block: the item's own, without the document.
    values
        By their names in the template; ``{{ value|to(".2f") }}`` formats one as Python does.
    """

    path: Path
    block: str
    values: Mapping[str, Any]

    def told(self, known: Mapping[str, Any]) -> str:
        """The sentences, on one line.

        Parameters
        ----------
        known
            Values that the template may use beside its own, which go first.

        Raises
        ------
        LedgerError
            There is no such template or block, or it cannot be filled with these values.
        """
        note(f"{ROOT}/{self.path.relative_to(_PACKAGE).as_posix()}")
        try:
            template = _template(self.path, self.path.stat().st_mtime_ns)
            fill = template.blocks[self.block]
            text = "".join(fill(template.new_context({**known, **self.values})))
        except (OSError, KeyError, TemplateError, TypeError, ValueError) as error:
            raise LedgerError(f"{self.path.name}, {self.block}: {error}") from None
        return " ".join(text.split())


def point(values: Sequence[float] | np.ndarray, digits: int = 4) -> str:
    """Coordinates as "x, y, z", without negative zeros."""
    return ", ".join(f"{value + 0.0:.{digits}f}" for value in np.round(values, 12))


def captions(page: str) -> Callable[..., Caption]:
    """``caption(block, **values)`` from the template beside a page, given as its ``__file__``."""
    path = Path(page).with_suffix(".j2").resolve()

    def caption(block: str, /, **values: Any) -> Caption:
        return Caption(path, block, values)

    return caption


@cache
def _template(path: Path, _changed: int) -> Template:
    made = Environment(undefined=StrictUndefined)
    made.filters["to"] = format
    made.filters["point"] = point
    return made.from_string(path.read_text(encoding="utf-8"))
