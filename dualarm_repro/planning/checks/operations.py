"""Operations of a compiled function, counted while its own source runs on numbers that count."""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any

import numpy as np


class Tally:
    """How many additions, multiplications, divisions and roots were made."""

    def __init__(self) -> None:
        self.count = 0


class Counted:
    """A number that adds one to its tally for every operation on it; comparisons are free."""

    __slots__ = ("tally", "value")

    def __init__(self, value: float, tally: Tally) -> None:
        self.value, self.tally = float(value), tally

    def _made(self, value: float) -> Counted:
        self.tally.count += 1
        return Counted(value, self.tally)

    def __add__(self, other: Any) -> Counted:
        return self._made(self.value + _plain(other))

    def __sub__(self, other: Any) -> Counted:
        return self._made(self.value - _plain(other))

    def __rsub__(self, other: Any) -> Counted:
        return self._made(_plain(other) - self.value)

    def __mul__(self, other: Any) -> Counted:
        return self._made(self.value * _plain(other))

    def __truediv__(self, other: Any) -> Counted:
        return self._made(self.value / _plain(other))

    def __rtruediv__(self, other: Any) -> Counted:
        return self._made(_plain(other) / self.value)

    def __pow__(self, other: Any) -> Counted:
        return self._made(self.value ** _plain(other))

    def __neg__(self) -> Counted:
        return Counted(-self.value, self.tally)

    __radd__, __rmul__ = __add__, __mul__

    def __lt__(self, other: Any) -> bool:
        return self.value < _plain(other)

    def __le__(self, other: Any) -> bool:
        return self.value <= _plain(other)

    def __gt__(self, other: Any) -> bool:
        return self.value > _plain(other)

    def __ge__(self, other: Any) -> bool:
        return self.value >= _plain(other)


def interpreted(function: Any) -> Callable[..., Any]:
    """The Python source of a compiled function, with every compiled function it calls likewise."""
    source = getattr(function, "py_func", function)
    names = dict(source.__globals__)
    for name in source.__code__.co_names:
        if hasattr(names.get(name), "py_func"):
            names[name] = interpreted(names[name])
    return FunctionType(source.__code__, names, source.__name__, source.__defaults__)


def operations(function: Any, *arguments: Any) -> int:
    """Operations of one call; arrays and tuples of numbers count, anything else is handed on."""
    tally = Tally()
    interpreted(function)(*(_counting(argument, tally) for argument in arguments))
    return tally.count


def _counting(argument: Any, tally: Tally) -> Any:
    if isinstance(argument, np.ndarray):
        made = np.empty(argument.shape, dtype=object)
        for place, value in np.ndenumerate(argument):
            made[place] = Counted(value, tally)
        return made
    if isinstance(argument, tuple):
        return tuple(Counted(value, tally) for value in argument)
    return Counted(argument, tally) if isinstance(argument, float) else argument


def _plain(value: Any) -> float:
    return value.value if isinstance(value, Counted) else float(value)
