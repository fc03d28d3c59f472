"""The card of an item: printed against obtained, assumptions, errata, robustness."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from io import BytesIO
from textwrap import wrap
from typing import Any

from markupsafe import Markup

from ..ledger.finding import finding_of
from ..ledger.meaning import MEANING
from ..ledger.printed import leaves
from ..ledger.verdict import Verdict
from .assumption_rows import assumption_rows, context_rows, rerun
from .badge import interval, percent
from .firmness import firmness_svg
from .item_files import KINDS, address
from .lines import line
from .printed_view import parts, printed_html
from .rendering import render
from .rule_sentences import SIGN, rule_sentence
from .source_code import highlighted, source_of
from .style import BLACK, PAD, SMALL, WIDTH, house_style
from .theme import lean, with_dark_rules
from .wording import (
    obtained_line,
    printed_line,
    search_lines,
    share_of,
    short,
    verdict_line,
)

#: A figure whose drawing would be larger than this is shown as pixels.
_LARGEST_SVG = 400_000
_LETTERS, _ROW = 110, 0.16  # of a line of the card of an item without a figure, and its height [in]
_INNER_DPI = 144  # of clouds and surfaces, which are pixels within a drawing
_FIGURE = Markup(
    '<figure class="ledger-figure"><p class="ledger-finding">{}</p>'
    '<img alt="{}" src="data:image/{};base64,{}">{}</figure>'
)


def figure_html(figure: Any, alt: str, caption: str, dpi: int = 130) -> Markup:
    """A figure as an inline image with alternative text and a caption; the figure is closed.

    The first sentence of the caption is the title. A drawing stays sharp at any size and follows
    the theme of the page; one of very many strokes is shown as pixels.
    """
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    with mpl.rc_context({"svg.hashsalt": "dualarm_repro"}):
        # Labels of 3-D axes stick out of the space that the layout keeps.
        data = lean(_saved(figure, "svg", metadata={"Date": None}, dpi=_INNER_DPI))
        kind = "svg+xml"
        if len(data) > _LARGEST_SVG:
            data, kind = _saved(figure, "png", dpi=dpi), "png"
        else:
            data = with_dark_rules(data)
    plt.close(figure)
    title, rest = finding_of(caption)
    below = Markup("<figcaption>{}</figcaption>").format(rest) if rest else ""
    return _FIGURE.format(title, alt, kind, b64encode(data).decode(), below)


def _saved(figure: Any, form: str, **options: Any) -> bytes:
    buffer = BytesIO()
    figure.savefig(buffer, format=form, bbox_inches="tight", pad_inches=PAD, **options)
    return buffer.getvalue()


def head_html(made: dict[str, Any], root: str | None = None) -> Markup:
    """Id, title and place of a record, then what is printed, obtained and decided, in words.

    Parameters
    ----------
    root
        Way from the page up to the top of the book; None on the item's own page.
    """
    kinds = {part.kind for part in parts(made)}
    in_words = kinds <= {"words", "lost"}
    told = printed_line(made) if in_words else line(made, "printed")
    whole = (
        told is not None
        and not kinds & {"table", "formula", "matrix"}
        and all(str(leaf) in told for _, leaf in leaves(made["printed"] or {}))
    )
    return render(
        "head",
        made=made,
        told=told,
        whole=None if whole else printed_html(made),
        obtained=obtained_line(made),
        decided=verdict_line(made),
        address=None if root is None else root + address(made["id"]),
    )


def card_html(
    made: dict[str, Any],
    root: str = "",
    files: Sequence[tuple[str, str]] = (),
    citations: Mapping[str, str] | None = None,
) -> Markup:
    """What a verdict rests on, folded: rules as sentences, assumptions, witnesses, robustness,
    errata, what is not printed, code, data and citations.

    Parameters
    ----------
    root
        Way from the page up to the top of the book, e.g. ``"../"``.
    files
        Kind and address of each file of the item.
    citations
        Name of a format to the citation.
    """
    found, verdict, code = made["robustness"], made["verdict"], made["code"]
    decider = made["decided_by"]
    proved = sum(1 for one in made["errata"] if one["proof"] and one["proof"]["holds"])
    source = source_of(code) if code else None
    return render(
        "card",
        made=made,
        checks=[(SIGN[c["outcome"]], c["outcome"], rule_sentence(c)) for c in made["checks"]],
        held=sum(c["outcome"] == "holds" for c in made["checks"]),
        rows=assumption_rows(made),
        context=context_rows(made),
        witnesses=[_witness(entry) for entry in made["witnesses"]],
        robustness=robustness_text(found, verdict, decider) if found else None,
        firmness=Markup(firmness_svg(found, verdict, decider)) if found else None,
        sought=search_lines(made),
        proved=f", {proved} proved by computation" if proved else "",
        code=_code(code, root),
        source=highlighted(source) if source else None,
        again=f"dualarm run {made['id']}",
        changed=rerun(made),
        files=[(kind, where, KINDS[kind]) for kind, where in files],
        citations=citations,
        own=lambda item_id: root + address(item_id),
    )


def _witness(entry: dict[str, Any]) -> dict[str, Any]:
    values = short(entry["values"]) if entry["values"] else "the values as declared"
    return {**entry, "values": values, "known": entry["verdict"] in set(Verdict)}


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

    rows = [[SIGN[check["outcome"]], rule_sentence(check)] for check in made["checks"]] or [
        ["", made["pending"] or ""]
    ]
    with house_style():
        told = [(sign, wrap(text, _LETTERS) or [""]) for sign, text in rows]
        height = 0.5 + _ROW * sum(len(lines) + 0.5 for _, lines in told)
        figure = plt.figure(figsize=(WIDTH, height))
        title = f"{made['id']}: {made['verdict']}"
        figure.text(0.0, 1.0, title, color=BLACK, weight="bold", va="top")
        y = height - 0.4
        for sign, lines in told:
            below = y / height
            figure.text(0.01, below, sign, color=BLACK, fontsize=SMALL, va="top")
            figure.text(0.04, below, "\n".join(lines), color=BLACK, fontsize=SMALL, va="top")
            y -= _ROW * (len(lines) + 0.5)
    return figure


def robustness_text(found: dict[str, Any], verdict: str, decided_by: str | None = None) -> str:
    """Robustness of a verdict in one sentence or two."""
    met = found["meets_print"]["share"]
    low, high = found["meets_print"]["interval"]
    text = (
        f"{share_of(verdict, decided_by).capitalize()} in {percent(met)} of {found['samples']} "
        f"draws of the assumptions (95 % interval {interval(low, high)}). "
    )
    flip = found["flip"]
    if flip is None:
        return text + "No single change within the plausible values flips the outcome."
    return text + (
        f"The smallest single change that flips the outcome: {short(flip['assumption'])} from "
        f"{short(flip['nominal'])} to {short(flip['value'])}, giving "
        f"{flip['verdict']}."
    )
