"""Numbers in attributes of XML elements."""

from __future__ import annotations

import math
from collections.abc import Callable
from xml.etree.ElementTree import Element


def numbers(element: Element, name: str) -> list[float]:
    """The finite numbers of an attribute; none if it is missing or holds anything else."""
    try:
        found = [float(part) for part in element.get(name, "").split()]
    except ValueError:
        return []
    return found if all(map(math.isfinite, found)) else []


def has(element: Element, name: str, count: int, holds: Callable[[float], bool]) -> bool:
    """Whether an attribute holds so many finite numbers, each of which fulfils a condition."""
    found = numbers(element, name)
    return len(found) == count and all(map(holds, found))


def positive(value: float) -> bool:
    """Above zero."""
    return value > 0.0


def anything(value: float) -> bool:
    """Any number."""
    return True


def not_zero(value: float) -> bool:
    """Other than zero."""
    return value != 0.0
