"""Stored studies of the ledger: what they are, and a spot check of each at every build."""

from __future__ import annotations

from html import escape

from ..errors import LedgerError
from ..ledger import Registry
from .page import Page

#: Cells of every study that a build recomputes, drawn with the seed.
CELLS = 3
SEED = 20261124


def studies_page(registry: Registry, cells: int = CELLS, seed: int = SEED) -> Page:
    """Table of the stored studies after recomputing a random share of each.

    Raises
    ------
    LedgerError
        A stored value differs from the recomputed one, or a study is stale.
    """
    rows = []
    for name, study in registry.studies.items():
        wrong = study.spot_check(cells, seed)
        if wrong:
            raise LedgerError("; ".join(wrong))
        meta = study.meta()
        rows.append(
            f"<tr><td><code>{escape(name)}</code></td><td>{escape(study.title)}</td>"
            f"<td>{meta['cells']}</td><td>{meta['seed']}</td>"
            f"<td>{min(cells, meta['cells'])} recomputed, equal</td></tr>"
        )
    head = "<tr><th>study</th><th>question</th><th>cells</th><th>seed</th><th>spot check</th></tr>"
    return Page(
        f'<div class="ledger-scroll"><table id="studies">{head}{"".join(rows)}</table></div>'
    )
