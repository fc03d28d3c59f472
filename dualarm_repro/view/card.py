"""The card of an item: printed against obtained, assumptions, errata, robustness."""

from __future__ import annotations

import json
from base64 import b64encode
from html import escape
from io import BytesIO
from typing import Any

from ..ledger.verdict import MEANING
from .badge import badge
from .style import BLACK, house_style

_DIGITS = 6


def figure_html(figure: Any, alt: str, caption: str, dpi: int = 130) -> str:
    """A figure as an inline PNG with alternative text and a caption; the figure is closed."""
    import matplotlib.pyplot as plt

    buffer = BytesIO()
    # Labels of 3-D axes stick out of the space that the layout keeps.
    figure.savefig(buffer, format="png", dpi=dpi, bbox_inches="tight")
    plt.close(figure)
    data = b64encode(buffer.getvalue()).decode()
    return (
        f'<figure class="ledger-figure"><img alt="{escape(alt)}" '
        f'src="data:image/png;base64,{data}"><figcaption>{escape(caption)}</figcaption></figure>'
    )


def head_html(made: dict[str, Any]) -> str:
    """Id, verdict, title and place of a record on one line."""
    title = f"{made['title']} ({made['kind']}, {made['place']})"
    return (
        f'<p class="ledger-head"><code>{made["id"]}</code> {badge(made["verdict"])} '
        f"<span>{escape(title)}</span></p>"
    )


def card_html(made: dict[str, Any]) -> str:
    """What a verdict rests on: checks, assumptions, errata, missing data, robustness."""
    parts = []
    if made["pending"]:
        parts.append(f"<p>Not attempted: {escape(made['pending'])}</p>")
    if made["change"] and made["verdict"] == "adapted":
        parts.append(f"<p>Changed input: {escape(made['change'])}</p>")
    if made["checks"]:
        parts.append(_checks(made["checks"]))
    for name, value in (made["measured"] or {}).items():
        parts.append(f"<p>Measured here: {escape(name)} = {short(value)}</p>")
    parts += [
        _section("Assumptions", [_assumption(entry) for entry in made["assumptions"]]),
        _section("Errata", [erratum_html(entry) for entry in made["errata"]]),
        _section("Not printed", [escape(datum) for datum in made["missing"]]),
        _section("Robustness", [robustness_text(made["robustness"])] if made["robustness"] else []),
        _section("Note", [escape(made["notes"])] if made["notes"] else []),
    ]
    return "".join(parts)


def card_figure(made: dict[str, Any]) -> Any:
    """The checks of a record as a figure, for items whose print is no picture."""
    import matplotlib.pyplot as plt

    rows = [
        [
            check["label"],
            check["expected"],
            short(check["obtained"]),
            "yes" if check["holds"] else "no",
        ]
        for check in made["checks"]
    ] or [[made["pending"] or "", "", "", ""]]
    with house_style():
        figure, ax = plt.subplots(figsize=(10, 1.2 + 0.4 * len(rows)))
        ax.axis("off")
        ax.set_title(f"{made['id']}: {made['verdict']}", color=BLACK, loc="left")
        cells = [[_cut(cell) for cell in row] for row in rows]
        header = ["statement", "expected", "obtained", "holds"]
        table = ax.table(cells, colLabels=header, loc="upper center", cellLoc="left")
        table.auto_set_font_size(False)
        table.set_fontsize(8)
        table.auto_set_column_width(list(range(len(header))))
    return figure


def short(value: Any) -> str:
    """A value on one line, floats to six significant digits."""
    if isinstance(value, float):
        return f"{value:.{_DIGITS}g}"
    if isinstance(value, list | tuple):
        return "(" + ", ".join(short(part) for part in value) + ")"
    if isinstance(value, dict):
        return "; ".join(f"{key}: {short(part)}" for key, part in value.items())
    if value is None:
        return "-"
    return value if isinstance(value, str) else json.dumps(value)


def robustness_text(found: dict[str, Any]) -> str:
    """Robustness of a verdict in one sentence."""
    low, high = found["interval"]
    text = (
        f"The verdict holds in {found['holds']:.1%} of {found['samples']} draws of the assumptions "
        f"(95 % interval {low:.1%} to {high:.1%}). "
    )
    flip = found["flip"]
    if flip is None:
        return text + "No single change within the plausible values flips it."
    return text + (
        f"The smallest single change that flips it: {escape(flip['assumption'])} from "
        f"{short(flip['nominal'])} to {short(flip['value'])}, giving {escape(flip['verdict'])}."
    )


def _checks(checks: list[dict[str, Any]]) -> str:
    rows = "".join(
        f"<tr><td>{escape(check['label'])}</td><td>{escape(check['expected'])}</td>"
        f"<td>{escape(short(check['obtained']))}</td>"
        f"<td>{'yes' if check['holds'] else 'no'}</td></tr>"
        for check in checks
    )
    head = "<tr><th>Statement</th><th>Expected</th><th>Obtained</th><th>Holds</th></tr>"
    return f'<div class="ledger-scroll"><table class="ledger-checks">{head}{rows}</table></div>'


def _assumption(entry: dict[str, Any]) -> str:
    unit = f" {entry['unit']}" if entry.get("unit") else ""
    value = escape(f"{short(entry['value'])}{unit}")
    return (
        f"<b>{escape(entry['id'])}</b> = {value} ({escape(entry['evidence'])}): "
        f"{escape(entry['statement'])} {escape(entry['why'])}"
    )


def erratum_html(entry: dict[str, Any]) -> str:
    """One erratum: place, problem, resolution and the outcome of its proof."""
    proof = entry["proof"]
    if proof is None:
        status = f"No machine proof: {escape(entry['no_proof'])}"
    else:
        word = "Proved" if proof["holds"] else "Proof fails"
        numbers = escape(short(proof["values"]))
        status = f"<b>{word}</b>: {escape(proof['statement'])} [{numbers}]"
    return (
        f"<b>{escape(entry['place'])}</b>: {escape(entry['problem'])} "
        f"<i>{escape(entry['resolution'])}</i> {status}"
    )


def _section(title: str, lines: list[str]) -> str:
    if not lines:
        return ""
    items = "".join(f"<li>{line}</li>" for line in lines)
    return f"<details><summary>{title} ({len(lines)})</summary><ul>{items}</ul></details>"


def _cut(text: str, limit: int = 60) -> str:
    return text if len(text) <= limit else text[: limit - 1] + "…"


def legend_html() -> str:
    """All verdicts with their meanings."""
    rows = "".join(f"<li>{badge(verdict)} {escape(text)}</li>" for verdict, text in MEANING.items())
    return f'<ul class="ledger-legend">{rows}</ul>'
