"""A drawing that follows the theme of the page: dark paper where the reader has chosen it.

A picture in a page resolves ``prefers-color-scheme`` by the ``color-scheme`` of its element, so
that one file serves both themes. Colours stay written at each stroke; the rules below only
replace them on dark paper, and a program that knows no such rules draws the light figure.
"""

from __future__ import annotations

from .style import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, SKY, ink

_PAPER = "#14181e"  # that of the theme
_INK = "#e4e6ea"
#: Light to dark: ink and greys turn round, the palette is lifted where it would be dim.
_DARK = {
    BLACK: _INK, "#1a1a1a": _INK, "#333333": "#d0d4da", "#4d4d4d": "#c0c5cc", "#595959": "#b4bac2",
    "#666666": "#a8aeb6", "#808080": "#9aa0a8", "#8c8c8c": "#9299a2", "#999999": "#848b94",
    "#b0b0b0": "#59616b", "#bfbfbf": "#565d66", "#cccccc": "#454b54", "#e0e0e0": "#2b3038",
    "#f2f2f2": "#3a414b", "#ffffff": _PAPER,
    BLUE: "#45a5e6", GREEN: "#20c596", RED: "#ff8242", ORANGE: "#f0b132", PURPLE: "#dd93bd",
    SKY: "#8ccbf2",
}  # fmt: skip
_DARK |= {ink(light): _DARK[light] for light in (ORANGE, GREEN, RED, PURPLE, SKY)}


def with_dark_rules(svg: bytes) -> bytes:
    """The drawing with the colours it has on dark paper."""
    head, tag, rest = svg.partition(b"<defs>")
    return head + b'<style type="text/css">' + _rules().encode() + b"</style>" + tag + rest


def _rules() -> str:
    one = "".join(
        f'[style*="{kind}: {light.lower()}"]{{{kind}:{dark}!important}}'
        for light, dark in _DARK.items()
        for kind in ("fill", "stroke")
    )
    # What is black is not written at each shape: it is inherited.
    return f"@media (prefers-color-scheme: dark){{svg{{fill:{_INK}}}{one}}}"
