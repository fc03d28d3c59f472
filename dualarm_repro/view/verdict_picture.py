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
#: How a number of items of a kind is called, one and several.
_KINDS = {
    "en": {
        Kind.FIGURE: ("figure", "figures"),
        Kind.TABLE: ("table", "tables"),
        Kind.EQUATION: ("equation", "equations"),
        Kind.CLAIM: ("claim", "claims"),
    },
    "zh": {
        Kind.FIGURE: ("幅图", "幅图"),
        Kind.TABLE: ("个表", "个表"),
        Kind.EQUATION: ("个公式", "个公式"),
        Kind.CLAIM: ("个论断", "个论断"),
    },
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


def panel(
    paper: str,
    title: str,
    records: Iterable[Mapping[str, Any]],
    root: str = "",
    language: str = "en",
) -> Panel:
    """Lay out the items of a document: kind below kind, in each the same verdicts side by side."""
    made = list(records)
    order = list(Verdict)
    headings, cells, y = [], [], 0
    for kind, (one, many) in _KINDS[language].items():
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


def verdict_picture(registry: Registry, root: str = "", language: str = "en") -> Page:
    """Every item of every document as a cell, and a legend with the number of each verdict.

    Parameters
    ----------
    root
        Way from the page up to the top of the book.
    language
        ``"en"``, or ``"zh"`` for original titles and no legend, which ``chinese.verdicts_page`` is.
    """
    panels = []
    for paper, file in registry.papers.items():
        records = [record(registry, f"{paper}.{key}") for key in file.items]
        document = file.document
        title = document.title if language == "en" else document.title_original or document.title
        panels.append(panel(paper, title, records, root, language))
    counted = tally(registry)["by_verdict"]
    legend = [(v, counted[v], MEANING[v]) for v in Verdict if counted[v]]
    return Page(
        render(
            "verdict_picture",
            panels=panels,
            legend=legend if language == "en" else [],
            side=PITCH - GAP,
            root=root,
            total=len(registry.items),
            skip="Skip the cells" if language == "en" else "跳过方格",
        )
    )


def answer_page(registry: Registry) -> Page:
    """What was found, in one sentence of counts."""
    return Page(render("answer", **tally(registry)))


def _cell(made: Mapping[str, Any], at: tuple[int, int], root: str) -> Cell:
    verdict = Verdict(made["verdict"])
    name = f"{made['id']}, {made['title']}: {verdict}"
    return Cell(*at, verdict, SIGN[verdict], name, root + address(made["id"]))
