"""How firmly a verdict holds, as a small picture: share with interval, and what it hangs on."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Any

from .wording import share_of

_WIDTH, _LABEL, _ROW = 460, 170, 20
_BAR = _WIDTH - _LABEL - 60
#: Assumptions shown, the most influential first.
_MOST = 5


def firmness_svg(robustness: Mapping[str, Any], verdict: str, decided_by: str | None = None) -> str:
    """Inline SVG that follows the colours of the page: one row for the share of draws that meet
    print, or have the properties of what has no original, then one for each assumption with an
    influence beyond chance."""
    met, counted = robustness["meets_print"], share_of(verdict, decided_by)
    rows = [_row(0, counted, met["share"], met["interval"], "#0072B2")]
    shown = list(robustness["influence"].items())[:_MOST]
    rows += [
        _row(k, name.replace("_", " "), index, None, "#E69F00")
        for k, (name, index) in enumerate(shown, 1)
    ]
    height = _ROW * len(rows) + 4
    draws = f"{100 * met['share']:.0f} % of {robustness['samples']} draws"
    text = f"{counted.capitalize()} in {draws}"
    if shown:
        named = ", ".join(f"{name} {index:.2f}" for name, index in shown)
        text += f"; first-order influence: {named}"
    return (
        f'<svg class="ledger-firmness" role="img" viewBox="0 0 {_WIDTH} {height}" '
        f'width="{_WIDTH}" height="{height}"><title>{escape(text)}</title>{"".join(rows)}</svg>'
    )


def _row(k: int, name: str, value: float, ends: Any, color: str) -> str:
    y = k * _ROW + 4
    middle = y + 7
    parts = [
        f'<text x="{_LABEL - 8}" y="{y + 11}" text-anchor="end">{escape(name)}</text>',
        f'<rect x="{_LABEL}" y="{y}" width="{_BAR}" height="14" class="ground"/>',
        f'<rect x="{_LABEL}" y="{y}" width="{_BAR * value:.1f}" height="14" fill="{color}"/>',
        f'<text x="{_LABEL + _BAR + 6}" y="{y + 11}">{value:.2f}</text>',
    ]
    if ends:
        low, high = (_LABEL + _BAR * end for end in ends)
        parts.append(
            f'<path d="M{low:.1f} {middle}H{high:.1f}M{low:.1f} {middle - 4}v8M{high:.1f} '
            f'{middle - 4}v8" class="whisker"/>'
        )
    return "".join(parts)
