"""Print that is well-formed and wrong: formulas, cells of matrices, digits."""

from __future__ import annotations

import re
from collections.abc import Iterator
from decimal import Decimal
from math import isfinite
from typing import Any

from ...errors import InputError
from ..formula import parse
from ..printed import leaves, read_number

_SIGN = re.compile(r"(?<=[\w)\]|]) ([+-]) (?=[\w(|\[])")
_POWER = re.compile(r"\^(\d)(?!\d)")
#: Not that of a sum, as in "sum_{i=1}^{5}".
_EQUAL = re.compile(r"(?<![<>!=])=(?!=)(?![^{}]*})")


def formulas(printed: Any) -> Iterator[tuple[tuple[Any, ...], str]]:
    """Every printed formula with its path; a formula stands below a key of that name."""
    for path, leaf in leaves(printed):
        if "formula" in path or "formulas" in path:
            yield path, leaf


def cells(printed: Any) -> Iterator[tuple[tuple[Any, ...], str]]:
    """Every cell of a printed matrix with its path; a matrix stands below a key of that name."""
    for path, leaf in leaves(printed):
        if "matrix" in path:
            yield path, leaf


def nonsense(text: str) -> list[str]:
    """Other formulas of the same names: a sign swapped, a power raised, a side doubled.

    Each parses where the original does, and says something else.
    """
    found = []
    if match := _SIGN.search(text):
        other = "-" if match[1] == "+" else "+"
        found.append(f"{text[: match.start(1)]}{other}{text[match.end(1) :]}")
    if match := _POWER.search(text):
        found.append(f"{text[: match.start(1)]}{int(match[1]) + 1}{text[match.end(1) :]}")
    if equal := list(_EQUAL.finditer(text)):
        found.append(f"{text[: equal[-1].end()]} 2*{text[equal[-1].end() :].lstrip()}")
    return [one for one in found or [f"2*{text}"] if _says_something_else(text, one)]


def other_cell(text: str) -> str:
    """Another cell of a matrix: 1 for 0, else 0."""
    return "1" if text.strip() == "0" else "0"


def other_digit(text: str) -> str | None:
    """The number with its last digit changed by one; None for a text that is no number.

    A multiple of pi becomes half as large again.
    """
    try:
        value, _ = read_number(text)
    except InputError:
        return None
    if "pi" in text:
        return repr(1.5 * value)
    number = Decimal(text.replace(" ", ""))
    return str(number + Decimal(1).scaleb(int(number.as_tuple().exponent)))


def moved(text: str, change: float) -> str:
    """The number moved by ``change``, with all its digits."""
    return repr(read_number(text)[0] + change)


def agreeing(value: Any) -> str | None:
    """The print that an obtained value agrees with; None where there is none."""
    if isinstance(value, float):
        return repr(value) if isfinite(value) else None
    return str(value) if isinstance(value, str | int) and value != "" else None


def _says_something_else(text: str, other: str) -> bool:
    """Where the original is of our notation, the other one is too and has other sides."""
    try:
        sides = parse(text).sides
    except InputError:
        return text != other
    try:
        return parse(other).sides != sides
    except InputError:
        return False
