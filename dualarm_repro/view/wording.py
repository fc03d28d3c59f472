"""Values and findings of a record in words, for cards and for the terminal alike."""

from __future__ import annotations

import json
from typing import Any

_DIGITS = 6


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


def share_of(verdict: str) -> str:
    """What the share of the draws counts: what has no original meets no print."""
    return "the properties hold" if verdict == "regenerated" else "print is met"


def search_lines(made: dict[str, Any]) -> list[str]:
    """How a witness was sought where none was found, and which is still to be sought."""
    lines, found = [], made["search"]
    if found:
        nearest = found["nearest"]
        how = "directed climbs and draws" if found["directed"] else "draws only, no directed search"
        lines.append(
            f"{how}: {found['evaluations']} evaluations; the nearest choice ({nearest['choice']}) "
            f"misses by {short(nearest['miss'])} of what is printed or bounded."
        )
    if made["seek"]:
        lines.append(f"Still to be sought: {made['seek']}")
    return lines
