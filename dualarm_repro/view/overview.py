"""Views of the whole ledger: verdict counts per document and the filterable table of all items."""

from __future__ import annotations

from html import escape
from typing import Any

import pandas as pd

from ..ledger import Registry, Verdict, record
from .badge import badge
from .card import legend_html
from .item_table import item_table
from .page import Page

_SCRIPT = """
(function () {
  const box = document.getElementById("ledger-table");
  const rows = Array.from(box.querySelectorAll("tbody tr"));
  const fields = ["paper", "kind", "verdict"];
  const selects = fields.map((name) => box.querySelector(`select[name=${name}]`));
  const words = box.querySelector("input");
  const count = box.querySelector("output");
  function update() {
    const needle = words.value.toLowerCase();
    let shown = 0;
    for (const row of rows) {
      const keep = selects.every((s) => !s.value || row.dataset[s.name] === s.value) &&
        row.textContent.toLowerCase().includes(needle);
      row.hidden = !keep;
      shown += keep;
    }
    count.textContent = `${shown} of ${rows.length} items`;
  }
  [...selects, words].forEach((element) => element.addEventListener("input", update));
  update();
})();
"""


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
    head = "".join(f"<th>{name}</th>" for name in table.index)
    rows = "".join(
        f"<tr><th>{badge(name) if name != 'total' else name}</th>"
        + "".join(f"<td>{value}</td>" for value in column)
        + "</tr>"
        for name, column in table.items()
    )
    return Page(
        '<div class="ledger-scroll"><table class="ledger-counts" id="verdict-counts">'
        f"<tr><th>verdict</th>{head}</tr>{rows}</table></div>"
    )


def legend_page() -> Page:
    """All verdicts with their meanings."""
    return Page(legend_html())


def ledger_page(registry: Registry) -> Page:
    """Every item in one table that filters by document, kind, verdict and words.

    Items link to the page that shows them; the table itself belongs on a top-level page.
    """
    records = [record(registry, item_id) for item_id in registry.items]
    choices = "".join(_select(name, records) for name in ("paper", "kind", "verdict"))
    return Page(
        f'<div id="ledger-table"><p class="ledger-filter">{choices}'
        '<label>words <input type="search"></label> <output></output></p>'
        f"{item_table(registry, registry.items)}</div><script>{_SCRIPT}</script>"
    )


def _select(name: str, records: list[dict[str, Any]]) -> str:
    values = dict.fromkeys(made[name] for made in records)
    options = "".join(f"<option>{escape(value)}</option>" for value in values)
    menu = f'<select name="{name}"><option value="">all</option>{options}</select>'
    return f"<label>{name} {menu}</label> "
