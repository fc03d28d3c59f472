"""Numbers as a reader wants them: few digits, powers of ten as such, shares as percentages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite, log10
from typing import Any

from .badge import percent

_DIGITS = 3
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
#: Below this share of the largest entry a component of a vector is round-off.
_NOTHING = 1e-9
#: How many entries of a list are shown before the rest is counted.
_MOST = 12
#: Names of fields that come in words of their own.
_WORDS = {True: "yes", False: "no", None: "none"}


def number(value: float, digits: int = _DIGITS) -> str:
    """A number to ``digits`` significant digits: 0.0251, 1250, 7 × 10⁻¹⁶."""
    if isinstance(value, int):
        return str(value)
    if not isfinite(value):
        return {True: "infinite", False: "minus infinite"}[value > 0] if value == value else "none"
    if value == 0.0:
        return "0"
    size = int(f"{abs(value):.{digits - 1}e}".partition("e")[2])
    if -4 <= size < 5:
        text = f"{value:.{max(digits - 1 - size, 0)}f}"
        return text.rstrip("0").rstrip(".") if "." in text else text
    mantissa, _, exponent = f"{value:.{min(digits, 2) - 1}e}".partition("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    power = f"10{str(int(exponent)).translate(_RAISED)}"
    return power if mantissa == "1" else f"{mantissa} × {power}"


def beside(value: float, printed: str) -> str:
    """A number with one digit more than the printed decimal it stands beside."""
    _, point, decimals = printed.partition(".")
    if isinstance(value, int) or not isfinite(value) or not decimals.isdigit() or not point:
        return number(value)
    return f"{value + 0.0:.{len(decimals) + 1}f}"


def words(value: Any, unit: str = "") -> str:
    """Any value of a record in words, with its unit."""
    if isinstance(value, bool) or value is None:
        return _WORDS[value]
    if isinstance(value, int | float):
        return _with(number(value), unit)
    if isinstance(value, str):
        return _with(value.replace("_", " ") if value.isidentifier() else value, unit)
    if isinstance(value, Mapping):
        return _mapping(value, unit)
    return _with(_sequence(value), unit)


def _with(text: str, unit: str) -> str:
    return f"{text} {unit}" if unit and text != "none" else text


def _mapping(value: Mapping[str, Any], unit: str) -> str:
    if {"count", "of"} <= value.keys() and value["of"]:
        share = percent(value["count"] / value["of"])
        return f"{value['count']} of {value['of']} ({share})"
    if {"value", "low", "high"} <= value.keys():
        low, high = number(value["low"]), number(value["high"])
        return f"{_with(number(value['value']), unit)} (95 % interval {low} to {high})"
    return "; ".join(f"{name.replace('_', ' ')}: {words(v, unit)}" for name, v in value.items())


def _sequence(value: Sequence[Any]) -> str:
    """Entries in parentheses, rounded alike and without what is round-off beside the largest."""
    entries = list(value)
    numbers = [one for one in entries if isinstance(one, float) and isfinite(one)]
    largest = max(map(abs, numbers), default=0.0)
    decimals = max(_DIGITS - int(log10(largest) // 1), 0) if 1e-4 <= largest < 1e5 else None

    def one(entry: Any) -> str:
        if not isinstance(entry, float) or not isfinite(entry):
            return words(entry)
        if abs(entry) <= _NOTHING * largest:
            return "0"
        if decimals is None:
            return number(entry)
        text = f"{entry:.{decimals}f}"
        text = text.rstrip("0").rstrip(".") if "." in text else text
        return "0" if text in ("-0", "") else text

    shown = [one(entry) for entry in entries[:_MOST]]
    if len(entries) > _MOST:
        shown.append(f"and {len(entries) - _MOST} more")
    return "(" + ", ".join(shown) + ")"
