"""What a page of the book shows of an item: figure, 3-D scene and verdict card in one output."""

from __future__ import annotations

import json
from html import escape

from ..ledger import Registry, evaluate, record
from ..ledger.cite import cite
from ..ledger.files import to_json
from ..ledger.record import compose
from .card import card_html, figure_html, head_html


class Page:
    """HTML that a notebook shows as the output of a cell."""

    def __init__(self, html: str) -> None:
        self.html = html

    def _repr_html_(self) -> str:
        return self.html


def present(registry: Registry, item_id: str, *, scene: bool = True) -> Page:
    """Evaluate an item now and lay out everything the ledger knows about it.

    Parameters
    ----------
    scene
        Whether to include the 3-D scene, if the item has one.
    """
    evaluation = evaluate(registry, item_id)
    result = evaluation.result
    fresh = result is not None and result.measured
    made = (
        json.loads(to_json(compose(registry, evaluation))) if fresh else record(registry, item_id)
    )
    parts = [head_html(made)]
    if result is not None:
        if result.figure:
            parts.append(figure_html(result.figure(), result.alt, result.caption))
        else:
            parts.append(f"<p>{escape(result.caption)}</p>")
        if result.scene and scene:
            parts.append(result.scene().page_html())
    parts.append(card_html(made))
    bibtex = escape(cite(registry, item_id, "bibtex", made["verdict"]))
    parts.append(f"<details><summary>Cite</summary><pre>{bibtex}</pre></details>")
    return Page(f'<div class="ledger-item" id="{item_id}">{"".join(parts)}</div>')
