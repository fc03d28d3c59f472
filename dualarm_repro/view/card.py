"""The card of an item: printed against obtained, assumptions, errata, robustness."""

from __future__ import annotations

from base64 import b64encode
from html import escape
from io import BytesIO
from typing import Any

from ..ledger.meaning import MEANING
from .badge import badge, interval, percent
from .firmness import firmness_svg
from .style import BLACK, house_style
from .wording import search_lines, share_of, short

#: A figure whose drawing would be larger than this is shown as pixels.
_LARGEST_SVG = 250_000


def figure_html(figure: Any, alt: str, caption: str, dpi: int = 130) -> str:
    """A figure as an inline image with alternative text and a caption; the figure is closed.

    A drawing stays sharp at any size; one of very many strokes is shown as pixels.
    """
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    with mpl.rc_context({"svg.hashsalt": "dualarm_repro"}):
        # Labels of 3-D axes stick out of the space that the layout keeps.
        data, kind = _saved(figure, "svg", metadata={"Date": None}), "svg+xml"
        if len(data) > _LARGEST_SVG:
            data, kind = _saved(figure, "png", dpi=dpi), "png"
    plt.close(figure)
    return (
        f'<figure class="ledger-figure"><img alt="{escape(alt)}" '
        f'src="data:image/{kind};base64,{b64encode(data).decode()}">'
        f"<figcaption>{escape(caption)}</figcaption></figure>"
    )


def _saved(figure: Any, form: str, **options: Any) -> bytes:
    buffer = BytesIO()
    figure.savefig(buffer, format=form, bbox_inches="tight", **options)
    return buffer.getvalue()


def head_html(made: dict[str, Any]) -> str:
    """Id, verdict, title and place of a record on one line."""
    title = f"{made['title']} ({made['kind']}, {made['place']})"
    return (
        f'<p class="ledger-head"><code>{made["id"]}</code> '
        f"{badge(made['verdict'], made['robustness'])} "
        f"<span>{escape(title)}</span></p>"
    )


def card_html(made: dict[str, Any], root: str = "") -> str:
    """What a verdict rests on: checks, witnesses, assumptions, errata, missing data, robustness.

    Parameters
    ----------
    root
        Way from the page up to the top of the book, e.g. ``"../"``.
    """
    parts = []
    if made["pending"]:
        parts.append(f"<p>Not attempted: {escape(made['pending'])}</p>")
    if made["change"] and made["verdict"] == "adapted":
        parts.append(f"<p>Changed input: {escape(made['change'])}</p>")
    if made["checks"]:
        parts.append(_checks(made["checks"]))
    if made["decided_by"]:
        parts.append(
            "<p>The source holds no original; the verdict is that of the statement of the text "
            f"<code>{made['decided_by']}</code>.</p>"
        )
    for name, value in (made["measured"] or {}).items():
        parts.append(f"<p>Measured here: {escape(name)} = {escape(short(value))}</p>")
    if made["robustness"]:
        parts.append(
            f"<p>{robustness_text(made['robustness'], made['verdict'])}</p>"
            f"{firmness_svg(made['robustness'], made['verdict'])}"
        )
    thresholds = [
        f"<b>{escape(name)}</b> = {entry['value']:g}: {escape(entry['reason'])}"
        for name, entry in made["thresholds"].items()
    ]
    sought = [escape(line) for line in search_lines(made)]
    parts += [
        _section("Witnesses", [_witness(entry) for entry in made["witnesses"]]),
        _section("Search for a witness", sought),
        _section("Thresholds", thresholds),
        _section("Assumptions", [_assumption(entry) for entry in made["assumptions"]]),
        _section("Context", [_assumption(entry) for entry in made["context"]]),
        _section("Errata", [erratum_html(entry) for entry in made["errata"]]),
        _section("Not printed", [escape(datum) for datum in made["missing"]]),
        _section("Note", [escape(made["notes"])] if made["notes"] else []),
        _code(made["code"], root),
    ]
    return "".join(parts)


def _witness(entry: dict[str, Any]) -> str:
    values = short(entry["values"]) if entry["values"] else "the values as declared"
    return f"<b>{escape(entry['verdict'])}</b> ({escape(entry['choice'])}): {escape(values)}"


def _code(code: dict[str, Any] | None, root: str) -> str:
    """Where the checker and its figure are written, linked to the source page."""
    if code is None:
        return ""
    places = {"checker": code} | ({"figure": code["figure"]} if code["figure"] else {})
    links = ", ".join(f"{name} {_source_link(entry, root)}" for name, entry in places.items())
    return f'<p class="ledger-code">Code: {links}</p>'


def _source_link(place: dict[str, Any], root: str) -> str:
    name = escape(f"{place['file']}:{place['line']} {place['function'].partition('.<locals>')[0]}")
    if place["line"] is None or not place["file"].startswith("dualarm_repro/"):
        return f"<code>{name}</code>"
    page = place["file"].removesuffix(".py").removesuffix("/__init__")
    outer = place["function"].partition(".<locals>")[0]
    anchor = "" if outer.startswith("_") else f"#{outer}"  # only what is public is marked there
    return f'<a href="{root}_modules/{page}.html{anchor}"><code>{name}</code></a>'


def card_figure(made: dict[str, Any]) -> Any:
    """The checks of a record as a figure, for items whose print is no picture."""
    import matplotlib.pyplot as plt

    rows = [
        [check["label"], check["expected"], short(check["obtained"]), check["outcome"]]
        for check in made["checks"]
    ] or [[made["pending"] or "", "", "", ""]]
    with house_style():
        figure, ax = plt.subplots(figsize=(10, 1.2 + 0.4 * len(rows)))
        ax.axis("off")
        ax.set_title(f"{made['id']}: {made['verdict']}", color=BLACK, loc="left")
        cells = [[_cut(cell) for cell in row] for row in rows]
        header = ["statement", "expected", "obtained", "outcome"]
        table = ax.table(cells, colLabels=header, loc="upper center", cellLoc="left")
        table.auto_set_font_size(False)
        table.set_fontsize(8)
        table.auto_set_column_width(list(range(len(header))))
    return figure


def robustness_text(found: dict[str, Any], verdict: str) -> str:
    """Robustness of a verdict in one sentence or two."""
    met, low, high = found["meets_print"]["share"], *found["meets_print"]["interval"]
    text = (
        f"{share_of(verdict).capitalize()} in {percent(met)} of {found['samples']} draws of the "
        f"assumptions (95 % interval {interval(low, high)}). "
    )
    flip = found["flip"]
    if flip is None:
        return text + "No single change within the plausible values flips the outcome."
    return text + (
        f"The smallest single change that flips the outcome: {escape(flip['assumption'])} from "
        f"{escape(short(flip['nominal']))} to {escape(short(flip['value']))}, giving "
        f"{escape(flip['verdict'])}."
    )


def _checks(checks: list[dict[str, Any]]) -> str:
    rows = "".join(
        f"<tr><td>{escape(check['label'])}</td><td>{escape(check['expected'])}</td>"
        f"<td>{escape(short(check['obtained']))}</td>"
        f"<td>{check['outcome']}</td></tr>"
        for check in checks
    )
    head = "<tr><th>Statement</th><th>Expected</th><th>Obtained</th><th>Outcome</th></tr>"
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
