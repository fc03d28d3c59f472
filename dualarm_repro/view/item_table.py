"""Items of the ledger as a compact list: one line an item, which opens to what is printed and
obtained."""

from __future__ import annotations

from collections.abc import Iterable

from markupsafe import Markup

from ..ledger import Registry, record
from .item_files import address
from .rendering import render
from .wording import summary_lines, verdict_line


def item_table(registry: Registry, item_ids: Iterable[str], root: str = "") -> Markup:
    """HTML of items, with links to the page of each and to its place in a chapter.

    Parameters
    ----------
    root
        Way from the page with the table up to the top of the book, e.g. ``"../"``.
    """
    records = [record(registry, item_id) for item_id in item_ids]
    rows = [
        {
            "made": made,
            "lines": summary_lines(made),
            "decided": verdict_line(made),
            "page": root + address(made["id"]),
            "home": root + made["url"] if made["url"] else None,
        }
        for made in records
    ]
    return render("items", rows=rows)
