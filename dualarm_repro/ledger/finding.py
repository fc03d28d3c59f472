"""The finding of a figure: the first sentence of its caption, which is its title."""

from __future__ import annotations

import re
from textwrap import wrap
from typing import Any

_SENTENCE = re.compile(r"(?<!\bFig)(?<!\bFigs)(?<!\bEq)(?<!\bvs)(?<!\.[a-z])\.\s+(?=[A-Z0-9(\[])")
_LETTERS, _LINES = 92, 3  # of a title above a figure that is as wide as the page


def finding_of(caption: str) -> tuple[str, str]:
    """The first sentence of a caption, without its full stop, and the rest."""
    first, *rest = _SENTENCE.split(caption.strip(), maxsplit=1)
    return first.removesuffix("."), rest[0] if rest else ""


def entitled(figure: Any, caption: str) -> Any:
    """The figure with its finding above it, for a file that stands by itself."""
    text = finding_of(caption)[0]
    letters = int(_LETTERS * min(1.0, figure.get_figwidth() / 7.5))
    lines = wrap(text, letters)
    if len(lines) > _LINES:
        lines = [*lines[: _LINES - 1], lines[_LINES - 1][: letters - 2] + " …"]
    figure.draw_without_rendering()  # legends and equal scales find their places
    figure.set_layout_engine("none")
    for legend in figure.legends:  # else it moves to the edge of the paper, which grows
        corner = figure.transFigure.inverted().transform(legend.get_window_extent().p0)
        legend.set_loc("lower left")
        legend.set_bbox_to_anchor(corner, transform=figure.transFigure)
        legend.borderaxespad = 0.0
    place = figure.get_tightbbox()
    figure.text(
        place.x0 / figure.get_figwidth(), (place.y1 + 0.12) / figure.get_figheight(),
        "\n".join(lines), fontsize=9.5, weight="bold", ha="left", va="bottom",
    )  # fmt: skip
    return figure
