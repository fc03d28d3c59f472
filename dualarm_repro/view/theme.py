"""A drawing that follows the theme of the page: dark paper where the reader has chosen it.

A picture in a page resolves ``prefers-color-scheme`` by the ``color-scheme`` of its element, so
that one file serves both themes. Colours stay written at each stroke; the rules below only
replace them on dark paper, and a program that knows no such rules draws the light figure.
"""

from __future__ import annotations

import re
from functools import cache

from matplotlib.colors import to_hex, to_rgb

from .style import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, SKY, ink

_PAPER = "#14181e"  # that of the theme
_INK = "#e4e6ea"
_OUTLINE, _FINE = re.compile(rb' d="[^"]*"'), re.compile(rb"(\.\d\d)\d+")
#: Light to dark: ink turns round, the palette is lifted where it would be dim.
_DARK = {
    BLACK: _INK, "#ffffff": _PAPER, "#b0b0b0": "#59616b",
    BLUE: "#45a5e6", GREEN: "#20c596", RED: "#ff8242", ORANGE: "#f0b132", PURPLE: "#dd93bd",
    SKY: "#8ccbf2",
}  # fmt: skip


def lean(svg: bytes) -> bytes:
    """The drawing with outlines to a hundredth of a point, which is finer than any screen."""
    return _OUTLINE.sub(lambda found: _FINE.sub(rb"\1", found[0]), svg)


def with_dark_rules(svg: bytes) -> bytes:
    """The drawing with the colours it has on dark paper."""
    head, tag, rest = svg.partition(b"<defs>")
    return head + b'<style type="text/css">' + _rules().encode() + b"</style>" + tag + rest


def _dark() -> dict[str, str]:
    """Light to dark: the palette, its inks, and greys, of which dark ones are ink on any paper."""
    inks = {ink(color): _DARK[color] for color in (ORANGE, GREEN, RED, PURPLE, SKY)}
    greys = {}
    for share in (k / 100 for k in range(5, 100, 5)):
        paper, letters = to_rgb(_PAPER), to_rgb(_INK)
        r, g, b = (share * p + (1 - share) * i for p, i in zip(paper, letters, strict=True))
        greys[to_hex(str(share))] = to_hex((r, g, b))
    return greys | inks | _DARK


@cache
def _rules() -> str:
    one = "".join(
        f'[style*="{kind}: {light.lower()}"]{{{kind}:{dark}!important}}'
        for light, dark in _dark().items()
        for kind in ("fill", "stroke")
    )
    # What is black is not written at each shape: it is inherited.
    return f"@media (prefers-color-scheme: dark){{svg{{fill:{_INK}}}{one}}}"
