"""Views of the whole ledger: verdict counts per document and the filterable table of all items."""

from __future__ import annotations

import pandas as pd

from ..ledger import Registry, Verdict, record
from .card import legend_html
from .item_table import item_table
from .page import Page
from .rendering import render

#: Fields of a record that the table of all items filters by, with what their menus are called.
_MENUS = {"paper": "document", "kind": "kind", "verdict": "verdict", "page": "page"}


def verdict_counts(registry: Registry) -> pd.DataFrame:
    """Number of items per document and verdict, with totals."""
    records = [record(registry, item_id) for item_id in registry.items]
    pairs = pd.DataFrame([(made["paper"], made["verdict"]) for made in records])
    table = pd.crosstab(pairs[0], pairs[1])
    table = table.reindex(index=list(registry.papers), columns=[v for v in Verdict if v in table])
    table["total"] = table.sum(axis=1)
    table.loc["total"] = table.sum()
    return table.rename_axis(index="document", columns=None)


def counts_page(registry: Registry) -> Page:
    """Verdict counts as a table with badges, one column per document."""
    table = verdict_counts(registry)
    return Page(render("counts", documents=list(table.index), rows=list(table.items())))


def legend_page() -> Page:
    """All verdicts with their meanings."""
    return Page(legend_html())


def ledger_page(registry: Registry) -> Page:
    """Every item on one line each, filtered by document, kind, verdict, page and words.

    What is chosen stands in the address; the table itself belongs on a top-level page.
    """
    records = [record(registry, item_id) for item_id in registry.items]
    menus = {
        field: (label, list(dict.fromkeys(made[field] for made in records if made[field])))
        for field, label in _MENUS.items()
    }
    return Page(render("ledger", menus=menus, table=item_table(registry, registry.items)))
