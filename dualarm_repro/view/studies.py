"""Stored studies of the ledger: what they are, and a spot check of each at every build."""

from __future__ import annotations

from html import escape

from ..errors import LedgerError
from ..ledger import Registry
from ..ledger.spot import Spot, seed_of_code, spot_check, spot_check_robustness
from .page import Page

#: Cells of every study, and items with one draw each, that a build recomputes.
CELLS, ITEMS = 1, 12


def studies_page(registry: Registry, cells: int = CELLS, seed: int | None = None) -> Page:
    """Table of the stored studies after recomputing a random share of each.

    Raises
    ------
    LedgerError
        A stored value differs from the recomputed one, or a study is stale.
    """
    drawn = seed_of_code() if seed is None else seed
    rows = []
    for study in registry.studies.values():
        spot = spot_check(study, cells, drawn)
        _require_equal([spot])
        meta, lacking = study.meta(), study.missing_peers()
        peers = f"; {', '.join(lacking)} not installed here, not compared" if lacking else ""
        loose = f", {len(spot.unsettled)} values by round-off" if spot.unsettled else ""
        rows.append(
            f"<tr><td><code>{escape(study.name)}</code></td><td>{escape(study.title)}</td>"
            f"<td>{meta['cells']}</td><td>{meta['seed']}</td>"
            f"<td>{spot.cells} recomputed, equal{loose}{escape(peers)}</td></tr>"
        )
    head = "<tr><th>study</th><th>question</th><th>cells</th><th>seed</th><th>spot check</th></tr>"
    return Page(
        f'<div class="ledger-scroll"><table id="studies">{head}{"".join(rows)}</table></div>'
    )


def robustness_page(registry: Registry, items: int = ITEMS, seed: int | None = None) -> Page:
    """How many items have stored draws, after recomputing one draw of some of them.

    Raises
    ------
    LedgerError
        A stored value differs from the recomputed one, or a study is stale.
    """
    drawn = seed_of_code() if seed is None else seed
    spots = spot_check_robustness(registry, items, drawn)
    _require_equal(spots)
    named = ", ".join(f"<code>{spot.study.name.partition('/')[2]}</code>" for spot in spots)
    return Page(f'<p id="robustness-spots">Recomputed and equal: one draw each of {named}.</p>')


def _require_equal(spots: list[Spot]) -> None:
    if wrong := [line for spot in spots for line in spot.wrong]:
        raise LedgerError("; ".join(wrong))
