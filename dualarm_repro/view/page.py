"""What a page of the book shows of an item: figure, 3-D scene and verdict card in one output."""

from __future__ import annotations

from html import escape
from typing import Any

from ..ledger import kept
from ..ledger.cite import cite
from ..ledger.evaluation import Evaluation
from ..ledger.record import located, make, record, roots
from ..ledger.registry import Registry
from .card import card_html, figure_html, head_html

_KIND = "pages"


class Page:
    """HTML that a notebook shows as the output of a cell."""

    def __init__(self, html: str) -> None:
        self.html = html

    def _repr_html_(self) -> str:
        return self.html


def present(registry: Registry, item_id: str, *, scene: bool = True) -> Page:
    """Lay out everything the ledger knows about an item.

    What was computed and drawn before is shown again while nothing it depends on has changed.

    Parameters
    ----------
    scene
        Whether to include the 3-D scene, if the item has one.

    Raises
    ------
    UnknownNameError
        No such item.
    """
    drawn = pictures(registry, item_id)
    made = record(registry, item_id)
    root = "../" * (made["page"] or "").count("/")
    parts: list[str] = [head_html(made)]
    if drawn["figure"]:
        parts.append(drawn["figure"])
    elif made["caption"]:
        parts.append(f"<p>{escape(made['caption'])}</p>")
    if drawn["scene"] and scene:
        parts.append(drawn["scene"])
    parts.append(card_html(made, root))
    bibtex = escape(cite(registry, item_id, "bibtex", made["verdict"]))
    parts.append(f"<details><summary>Cite</summary><pre>{bibtex}</pre></details>")
    return Page(f'<div class="ledger-item" id="{item_id}">{"".join(parts)}</div>')


def pictures(registry: Registry, item_id: str) -> dict[str, str | None]:
    """Figure and 3-D scene of an item as HTML, drawn now or kept from before."""
    registry.look(item_id)
    found = kept.read(registry, _KIND, item_id)
    if found is None:
        entry, evaluation = make(registry, item_id)
        found = _draw(located(entry["record"]), evaluation)
        modules = {*roots(registry, item_id), __name__}
        kept.keep(registry, _KIND, item_id, found, modules, entry["inputs"], drawn=True)
    return found


def _draw(made: dict[str, Any], evaluation: Evaluation) -> dict[str, str | None]:
    result = evaluation.result
    if result is None:
        return {"figure": None, "scene": None}
    figure = None
    if result.figure and result.alt:
        figure = figure_html(result.figure(), result.alt, result.told())
    return {"figure": figure, "scene": result.scene().page_html() if result.scene else None}
