"""All verdicts in one picture: each item a cell that names it and leads to its page."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ..ledger import Registry, Verdict, record
from ..ledger.meaning import MEANING
from ..ledger.schema import Kind
from .badge import SIGN
from .item_files import address
from .page import Page
from .rendering import render
from .tally import tally

#: Side of a cell with its gap [px]: a finger hits it, and fourteen in a row fit a phone.
PITCH, GAP, ROW = 25, 2, 14
_HEAD, _AFTER = 19, 7
_KINDS = {
    Kind.FIGURE: ("figure", "figures"),
    Kind.TABLE: ("table", "tables"),
    Kind.EQUATION: ("equation", "equations"),
    Kind.CLAIM: ("claim", "claims"),
}


@dataclass(frozen=True)
class Cell:
    """An item in the picture: corner [px], what it is called, and where it leads."""

    x: int
    y: int
    verdict: Verdict
    sign: str
    name: str
    address: str


@dataclass(frozen=True)
class Panel:
    """A document in the picture: its size [px], headings with their height, and its cells."""

    paper: str
    title: str
    width: int
    height: int
    headings: tuple[tuple[int, str], ...]
    cells: tuple[Cell, ...]


def panel(paper: str, title: str, records: Iterable[Mapping[str, Any]], root: str = "") -> Panel:
    """Lay out the items of a document: kind below kind, in each the same verdicts side by side."""
    made = list(records)
    order = list(Verdict)
    headings, cells, y = [], [], 0
    for kind, (one, many) in _KINDS.items():
        chosen = [m for m in made if m["kind"] == kind]
        if not chosen:
            continue
        chosen.sort(key=lambda m: order.index(Verdict(m["verdict"])))  # stable: as printed
        headings.append((y + _HEAD - 6, f"{len(chosen)} {one if len(chosen) == 1 else many}"))
        y += _HEAD
        for k, m in enumerate(chosen):
            at = (k % ROW * PITCH, y + k // ROW * PITCH)
            cells.append(_cell(m, at, root))
        y += -(-len(chosen) // ROW) * PITCH + _AFTER
    return Panel(paper, title, ROW * PITCH - GAP, y, tuple(headings), tuple(cells))


def verdict_picture(registry: Registry, root: str = "") -> Page:
    """Every item of every document as a cell, and a legend with the number of each verdict.

    Parameters
    ----------
    root
        Way from the page up to the top of the book.
    """
    panels = []
    for paper, file in registry.papers.items():
        records = [record(registry, f"{paper}.{key}") for key in file.items]
        panels.append(panel(paper, file.document.title, records, root))
    counted = tally(registry)["by_verdict"]
    legend = [(v, counted[v], MEANING[v]) for v in Verdict if counted[v]]
    side = PITCH - GAP
    total = len(registry.items)
    return Page(
        render("verdict_picture", panels=panels, legend=legend, side=side, root=root, total=total)
    )


def answer_page(registry: Registry) -> Page:
    """What was found, in one sentence of counts."""
    return Page(render("answer", **tally(registry)))


def _cell(made: Mapping[str, Any], at: tuple[int, int], root: str) -> Cell:
    verdict = Verdict(made["verdict"])
    name = f"{made['id']}, {made['title']}: {verdict}"
    return Cell(*at, verdict, SIGN[verdict], name, root + address(made["id"]))
