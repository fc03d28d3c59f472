"""What was changed to see whether the ledger notices, and how much of it was noticed."""

from __future__ import annotations

from html import escape
from typing import Any

from ..ledger import Registry
from ..ledger.trust.report import digest_of, read_report
from .page import Page

_WHAT = {
    "obtained": "what is obtained: each rule broken by the value it looks at, each verdict by its "
    "rules",
    "printed": "what is printed: formulas turned to nonsense, cells of matrices, digits",
    "assumed": "what is assumed: each assumption changed, each draw computed",
    "method": "the method: one number or operator of its source exchanged",
}


def trust_page(registry: Registry) -> Page:
    """Changes in four directions: how many were tried, how many were noticed, what was not."""
    found = read_report()
    if found is None:
        return Page('<p id="trust">Nothing is stored; <code>make trust-ledger</code> runs it.</p>')
    rows = "".join(
        f"<tr><td>{_WHAT[name]}</td><td>{counts['tried']}</td><td>{counts['killed']}</td>"
        f"<td>{counts['survived']}</td></tr>"
        for name, counts in found["counts"].items()
    )
    method = found["counts"]["method"]
    known = set(registry.checkers)
    items = {line.partition(":")[0] for lines in found["open"].values() for line in lines} & known
    head = "<tr><th>changed</th><th>tried</th><th>noticed</th><th>not noticed</th></tr>"
    same = digest_of(found["rooms"]) == found["code"]
    return Page(
        f'<div class="ledger-scroll"><table id="trust">{head}{rows}</table></div>'
        f"<p>The mutants of the method are drawn with seed {found['seed']}; "
        f"{method['equivalent']} more change no value, each for a reason that is given. "
        f"Items that hold something that could not be tried: {len(items)}. "
        f"{'' if same else 'The methods have changed since; '}"
        "<code>make trust-ledger</code> tries all of it again.</p>"
        f"{_unnoticed(found)}"
    )


def _unnoticed(found: dict[str, Any]) -> str:
    lines = [line for lines in found["survived"].values() for line in lines]
    lines += [
        f"{row['file']}:{row['line']} {row['old']} -> {row['new']}"
        for row in found["mutants"]
        if not row["killed_by"] and not row["equivalent"]
    ]
    if not lines:
        return ""
    listed = "".join(f"<li>{escape(line)}</li>" for line in lines)
    return f"<details><summary>Not noticed</summary><ul>{listed}</ul></details>"
