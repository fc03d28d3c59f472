"""What a page of the book shows of an item: figure, 3-D scene and verdict card in one output."""

from __future__ import annotations

from html import escape
from typing import Any

from ..ledger import kept
from ..ledger.cite import cite
from ..ledger.evaluation import Evaluation
from ..ledger.export import data_table
from ..ledger.files import to_json
from ..ledger.record import located, make, record, roots
from ..ledger.registry import Registry
from .card import card_html, figure_html, head_html
from .item_files import beside_page, links
from .legibility import faults
from .running_notebook import with_style

_KIND = "pages"
#: A table of more bytes is not copied into the book; `dualarm run` writes it.
_LARGEST_CSV = 1_000_000


class Page:
    """HTML that a notebook shows as the output of a cell."""

    def __init__(self, html: str) -> None:
        self.html = html

    def __repr__(self) -> str:
        return f"{type(self).__name__} of {len(self.html)} characters of HTML"

    def _repr_html_(self) -> str:
        return with_style(self.html)


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
    made = record(registry, item_id)
    root = "../" * (made["page"] or "").count("/")
    return Page(card(registry, made, root, scene=scene))


def own_page(registry: Registry, item_id: str) -> str:
    """The card of an item for the page that it has of its own, one folder below the top.

    Raises
    ------
    UnknownNameError
        No such item.
    """
    made = record(registry, item_id)
    where = f"{made['url']}" if made["url"] else "ledger.html"
    ways = (
        f'<p class="ledger-way"><a href="../{where}">In its chapter</a> · '
        f'<a href="../{made["paper"]}/index.html">The document</a> · '
        '<a href="../ledger.html">The ledger</a></p>'
    )
    return ways + card(registry, made, "../", own=True)


def card(
    registry: Registry, made: dict[str, Any], root: str, *, scene: bool = True, own: bool = False
) -> str:
    """HTML of a card.

    Parameters
    ----------
    root
        Way from the page up to the top of the book.
    own
        Whether it stands on the item's own page: there the figure is a file beside it.
    """
    item_id, drawn = made["id"], pictures(registry, made["id"])
    files = links(made, drawn, root)
    parts: list[str] = [head_html(made, None if own else root)]
    if drawn["figure"]:
        parts.append(beside_page(drawn["figure"], files) if own else drawn["figure"])
    elif made["caption"]:
        parts.append(f'<p class="ledger-caption">{escape(made["caption"])}</p>')
    if drawn["scene"] and scene:
        parts.append(f'<div class="ledger-stage">{drawn["scene"]}</div>')
    parts.append(card_html(made, root, files, citations(registry, made)))
    place = 'id="card"' if own else f'id="{item_id}"'
    return f'<article class="ledger-item" {place}>{"".join(parts)}</article>'


def citations(registry: Registry, made: dict[str, Any]) -> dict[str, str]:
    """The citations of an item by the name of their format."""
    item_id, verdict = made["id"], made["verdict"]
    return {
        "BibTeX": cite(registry, item_id, "bibtex", verdict),
        "CSL-JSON": to_json(cite(registry, item_id, "csl-json", verdict)),
    }


def pictures(registry: Registry, item_id: str) -> dict[str, Any]:
    """Figure and 3-D scene of an item as HTML, its data as CSV, and what is wrong with the figure
    (see ``legibility.faults``), made now or kept from before."""
    registry.look(item_id)
    found = kept.read(registry, _KIND, item_id)
    if found is None:
        entry, evaluation = make(registry, item_id)
        found = _draw(located(entry["record"]), evaluation)
        modules = {*roots(registry, item_id), __name__}
        kept.keep(registry, _KIND, item_id, found, modules, entry["inputs"], drawn=True)
    return found


def _draw(made: dict[str, Any], evaluation: Evaluation) -> dict[str, Any]:
    result = evaluation.result
    if result is None:
        return {"figure": None, "scene": None, "csv": None, "faults": []}
    csv = data_table(evaluation, made).to_csv(index=False)
    figure, wrong = None, []
    if result.figure and result.alt:
        drawn = result.figure()
        wrong = faults(drawn)
        figure = figure_html(drawn, result.alt, result.told())
    return {
        "figure": figure,
        "scene": result.scene().page_html() if result.scene else None,
        "csv": csv if len(csv) <= _LARGEST_CSV else None,
        "faults": wrong,
    }
