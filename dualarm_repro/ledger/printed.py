"""Printed numbers: what digits promise.

A printed decimal with k digits after the point stands for every value that rounds to it, that is
``|x - printed| <= 0.5 * 10**-k``. Expressions in pi are exact.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from math import pi
from typing import Any

from ..errors import InputError

EXACT = 1e-12
_PI = re.compile(r"^(-?)(?:(\d+)\*)?pi(?:/(\d+))?$")


def read_number(text: str) -> tuple[float, float]:
    """Value and half-unit tolerance of a printed number.

    Parameters
    ----------
    text
        Decimal ("0.285", "-1.5e-3") or multiple of pi ("-pi/8").

    Raises
    ------
    InputError
        The text is no number.
    """
    compact = text.replace(" ", "")
    match = _PI.match(compact)
    if match:
        sign, factor, divisor = match.groups()
        ratio = Fraction(int(factor or 1), int(divisor or 1))
        return (-1 if sign else 1) * float(ratio) * pi, EXACT
    try:
        value = Decimal(compact)
        exponent = value.as_tuple().exponent
        if not isinstance(exponent, int):  # NaN and infinity
            raise InvalidOperation
    except InvalidOperation:
        raise InputError("printed value", "number", text, "a decimal or a multiple of pi") from None
    return float(value), float(Decimal(5).scaleb(exponent - 1))


def rounds_to(obtained: float, text: str) -> bool:
    """Whether ``obtained`` rounds to the printed digits of ``text``."""
    value, half_unit = read_number(text)
    return abs(obtained - value) <= half_unit * (1 + 1e-9)


def leaves(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    """All leaves of nested lists and mappings with their paths."""
    if isinstance(value, dict):
        for key, part in value.items():
            yield from leaves(part, (*path, key))
    elif isinstance(value, list | tuple):
        for index, part in enumerate(value):
            yield from leaves(part, (*path, index))
    else:
        yield path, value


def at(value: Any, path: str | tuple[Any, ...]) -> Any:
    """The part of a nested value at a dotted path (``"row.0"``) or a tuple of keys.

    Raises
    ------
    InputError
        There is nothing at that path.
    """
    parts = tuple(path.split(".")) if isinstance(path, str) else path
    for part in parts:
        try:
            value = value[int(part)] if isinstance(value, list | tuple) else value[part]
        except (KeyError, IndexError, ValueError, TypeError):
            raise InputError(
                "ledger", "path", ".".join(map(str, parts)), "an existing key"
            ) from None
    return value


def replaced(value: Any, path: tuple[Any, ...], leaf: Any) -> Any:
    """A copy of a nested value with the leaf at ``path`` exchanged."""
    if not path:
        return leaf
    head, rest = path[0], path[1:]
    if isinstance(value, dict):
        return {**value, head: replaced(value.get(head), rest, leaf)}
    if isinstance(value, list | tuple):
        copy = list(value)
        copy[int(head)] = replaced(copy[int(head)], rest, leaf)
        return copy
    return {head: replaced(None, rest, leaf)}
