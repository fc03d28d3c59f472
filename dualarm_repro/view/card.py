"""The card of an item: printed against obtained, assumptions, errata, robustness."""

from __future__ import annotations

from base64 import b64encode
from io import BytesIO
from typing import Any

from markupsafe import Markup

from ..ledger.meaning import MEANING
from .badge import interval, percent
from .firmness import firmness_svg
from .rendering import render
from .style import BLACK, house_style
from .wording import search_lines, share_of, short

#: A figure whose drawing would be larger than this is shown as pixels.
_LARGEST_SVG = 250_000
_FIGURE = Markup(
    '<figure class="ledger-figure"><img alt="{}" src="data:image/{};base64,{}">'
    "<figcaption>{}</figcaption></figure>"
)


def figure_html(figure: Any, alt: str, caption: str, dpi: int = 130) -> Markup:
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
    return _FIGURE.format(alt, kind, b64encode(data).decode(), caption)


def _saved(figure: Any, form: str, **options: Any) -> bytes:
    buffer = BytesIO()
    figure.savefig(buffer, format=form, bbox_inches="tight", **options)
    return buffer.getvalue()


def head_html(made: dict[str, Any]) -> Markup:
    """Id, verdict, title and place of a record on one line."""
    return render("head", made=made)


def card_html(made: dict[str, Any], root: str = "") -> Markup:
    """What a verdict rests on: checks, witnesses, assumptions, errata, missing data, robustness.

    Parameters
    ----------
    root
        Way from the page up to the top of the book, e.g. ``"../"``.
    """
    found, verdict = made["robustness"], made["verdict"]
    return render(
        "card",
        made=made,
        robustness=robustness_text(found, verdict) if found else None,
        firmness=Markup(firmness_svg(found, verdict)) if found else None,
        sought=search_lines(made),
        code=_code(made["code"], root),
    )


def erratum_html(entry: dict[str, Any]) -> Markup:
    """One erratum: place, problem, resolution and the outcome of its proof."""
    return render("erratum", entry=entry)


def legend_html() -> Markup:
    """All verdicts with their meanings."""
    return render("legend", meanings=MEANING)


def _code(code: dict[str, Any] | None, root: str) -> list[tuple[str, str, str | None]]:
    """Where the checker and its figure are written: what it is, the place, and its address."""
    places = {"checker": code, "figure": code and code["figure"]}
    return [(name, *_source(place, root)) for name, place in places.items() if place]


def _source(place: dict[str, Any], root: str) -> tuple[str, str | None]:
    """File, line and function as text, and the address of the highlighted source line."""
    file, outer = place["file"], place["function"].partition(".<locals>")[0]
    text = f"{file}:{place['line']} {outer}"
    if place["line"] is None or not file.startswith("dualarm_repro/"):
        return text, None
    page = file.removesuffix(".py").removesuffix("/__init__")
    anchor = "" if outer.startswith("_") else f"#{outer}"  # only what is public is marked there
    return text, f"{root}_modules/{page}.html{anchor}"


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
    met = found["meets_print"]["share"]
    low, high = found["meets_print"]["interval"]
    text = (
        f"{share_of(verdict).capitalize()} in {percent(met)} of {found['samples']} draws of the "
        f"assumptions (95 % interval {interval(low, high)}). "
    )
    flip = found["flip"]
    if flip is None:
        return text + "No single change within the plausible values flips the outcome."
    return text + (
        f"The smallest single change that flips the outcome: {flip['assumption']} from "
        f"{short(flip['nominal'])} to {short(flip['value'])}, giving "
        f"{flip['verdict']}."
    )


def _cut(text: str, limit: int = 60) -> str:
    return text if len(text) <= limit else text[: limit - 1] + "…"
