"""What an annotation asks of a value: numbers, arrays, choices, instances and their containers."""

from __future__ import annotations

import math
import numbers
import operator
import types
import typing
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from pydantic.fields import FieldInfo

from .errors import InputError, UnknownNameError

#: Mark of a number or an array in which NaN or infinity has a meaning.
OPEN = "may hold NaN or infinity"
#: Mark of a number or an array that may be infinite, but not NaN.
INFINITE = "may be infinite"
#: Mark of an array that must not be empty.
FILLED = "not empty"
#: Mark of an array that the class itself checks, with an error of its own kind.
LATER = "checked by the class"
#: Mark of an array of truth values.
MASK = "truth values"


class Shape(tuple):
    """Lengths of the axes of an array: a number, or a letter that is the same length everywhere in
    one call; ``...`` first stands for any further axes."""

    def __new__(cls, *lengths: Any) -> Shape:
        return super().__new__(cls, lengths)

    def __str__(self) -> str:
        inside = ", ".join("..." if one is ... else str(one) for one in self)
        return f"({inside},)" if len(self) == 1 else f"({inside})"

    def fits(self, shape: tuple[int, ...], sizes: dict[str, int]) -> bool:
        """Whether a shape has these lengths; letters are noted in ``sizes``."""
        wanted: tuple[Any, ...] = self
        if wanted and wanted[0] is ...:
            wanted = wanted[1:]
            shape = shape[max(len(shape) - len(wanted), 0) :]
        if len(shape) != len(wanted):
            return False
        met: dict[str, int] = {}
        for one, length in zip(wanted, shape, strict=True):
            if isinstance(one, str):
                one = sizes.get(one, met.setdefault(one, length))
            if one != length:
                return False
        sizes.update(met)
        return True

    def told(self, sizes: dict[str, int]) -> str:
        """The shape, and the lengths of its letters that are known already."""
        known = [f"{one} = {sizes[one]}" for one in dict.fromkeys(self) if one in sizes]
        return ", ".join([str(self), *known])


@dataclass(frozen=True)
class Requirement:
    """What a value has to be: ``accept`` gives the value to use, or raises :class:`_Wrong`."""

    expected: str
    accept: Callable[[Any, dict[str, int]], Any]
    unknown_name: bool = False

    def checked(self, source: str, field: str, value: Any, sizes: dict[str, int]) -> Any:
        """The value to use.

        Raises
        ------
        InputError, UnknownNameError
            It does not fit.
        """
        try:
            return self.accept(value, sizes)
        except _Wrong as wrong:
            kind = UnknownNameError if self.unknown_name else InputError
            inner = wrong.field and f"{field}{wrong.field}"
            raise kind(source, inner or field, wrong.value, wrong.expected) from None


def real_array(value: Any) -> np.ndarray:
    """Numbers as an array of float64; text, truth values, dates and masked values are none.

    Raises
    ------
    TypeError, ValueError
        They are no real numbers, or of no common shape.
    """
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"numbers, not {array.dtype}")
    return np.asarray(array, dtype=float, order="C")


class _Wrong(Exception):
    """A value, or the part of it at ``field``, that does not fit."""

    def __init__(self, value: Any, expected: str, field: str = "") -> None:
        self.value, self.expected, self.field = value, expected, field


def requirement_of(kind: Any) -> Requirement:
    """What an annotation asks for."""
    marks: tuple[Any, ...] = ()
    if typing.get_origin(kind) is typing.Annotated:
        kind, *found = typing.get_args(kind)
        marks = tuple(found)
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if LATER in marks or (kind is ArrayLike and not marks):
        # Whoever takes any array-like makes an array of it, and checks that.
        return Requirement("numbers", lambda value, _: value)
    if kind is ArrayLike or kind is np.ndarray or origin is np.ndarray:
        return _array(kind is not ArrayLike, marks)
    if origin in (typing.Union, types.UnionType):
        return _either([requirement_of(one) for one in inner])
    if kind is None or kind is type(None):
        return Requirement("None", lambda value, _: _only(value is None, value, "None"))
    if origin is typing.Literal:
        return _choice(inner)
    if origin is not None and isinstance(origin, type):
        return _container(origin, inner)
    return _scalar(kind, marks)


def _scalar(kind: Any, marks: tuple[Any, ...]) -> Requirement:
    if kind is bool:
        return _instance((bool, np.bool_), "true or false")
    if kind in (int, float):
        return _number(kind, marks)
    if kind is str:
        return _instance((str,), "text")
    if kind is Path:
        return Requirement("a path", _path)
    if isinstance(kind, type) and issubclass(kind, StrEnum):
        return _choice(tuple(kind), kind)
    if (
        isinstance(kind, type)
        and kind not in (object, Any)
        and not getattr(kind, "_is_protocol", False)
    ):
        article = "an" if kind.__name__[0] in "AEIOU" else "a"
        return _instance((kind,), f"{article} {kind.__name__}")
    return Requirement("anything", lambda value, _: value)


def _only(fits: bool, value: Any, expected: str) -> Any:
    if not fits:
        raise _Wrong(value, expected)
    return value


def _instance(kinds: tuple[type, ...], expected: str) -> Requirement:
    return Requirement(expected, lambda value, _: _only(isinstance(value, kinds), value, expected))


def _function(value: Any, _: dict[str, int]) -> Any:
    return _only(callable(value), value, "a function")


def _path(value: Any, _: dict[str, int]) -> Path:
    if not isinstance(value, str | Path) or not str(value) or "\0" in str(value):
        raise _Wrong(value, "a path")
    return Path(value)


def _choice(names: tuple[Any, ...], kind: Callable[[Any], Any] = lambda name: name) -> Requirement:
    expected = f"one of {', '.join(map(str, names))}"

    def accept(value: Any, _: dict[str, int]) -> Any:
        if not isinstance(value, str) or value not in names:
            raise _Wrong(value, expected)
        return kind(value)

    return Requirement(expected, accept, unknown_name=True)


def _number(kind: type, marks: tuple[Any, ...]) -> Requirement:
    wanted: Any = numbers.Integral if kind is int else numbers.Real
    limits = [one for mark in marks if isinstance(mark, FieldInfo) for one in mark.metadata]
    bounds = [
        (sign, getattr(one, sign)) for one in limits for sign in _BOUNDS if hasattr(one, sign)
    ]
    kind_of = "a whole number" if kind is int else "a number"
    endless = OPEN in marks or INFINITE in marks
    words = [kind_of if kind is int or endless else "a finite number"]
    words += [f"{_BOUNDS[sign][0]} {bound}" for sign, bound in bounds]
    expected = ", ".join(words)

    def accept(value: Any, _: dict[str, int]) -> Any:
        if type(value) is float and kind is float and not bounds and abs(value) < _LARGEST:
            return value  # the usual case, at little cost
        if not isinstance(value, wanted) or isinstance(value, bool | np.bool_):
            raise _Wrong(value, expected)
        try:
            size = float(value)
        except OverflowError:
            raise _Wrong(value, expected) from None
        if kind is int and abs(value) >= _MACHINE:
            raise _Wrong(value, expected)
        if not (endless or abs(size) < _LARGEST) or (math.isnan(size) and OPEN not in marks):
            raise _Wrong(value, expected)
        if not all(_BOUNDS[sign][1](size, bound) for sign, bound in bounds):
            raise _Wrong(value, expected)
        if isinstance(value, float) and value == 0.0:
            return 0.0  # also of -0.0, which would make an interval of negative length
        return value if isinstance(value, int | float) else kind(value)

    return Requirement(expected, accept)


_LARGEST = 1e100  # the squares of larger numbers soon are infinite
_MACHINE = 2**63  # whole numbers from here on are none of the machine
_BOUNDS: dict[str, tuple[str, Callable[[float, float], bool]]] = {
    "gt": ("above", operator.gt),
    "ge": ("at least", operator.ge),
    "le": ("at most", operator.le),
    "lt": ("below", operator.lt),
}


def _array(convert: bool, marks: tuple[Any, ...]) -> Requirement:
    shape = next((mark for mark in marks if isinstance(mark, Shape)), None)
    kinds = "b" if MASK in marks else "fiu"
    endless = OPEN in marks or INFINITE in marks
    what = "truth values" if MASK in marks else "numbers" if endless else "finite numbers"
    filled = f", {FILLED}" if FILLED in marks else ""
    expected = f"{what} {shape}{filled}" if shape else f"{what}{filled}"

    def accept(value: Any, sizes: dict[str, int]) -> Any:
        try:
            array = np.asarray(value)
        except (TypeError, ValueError, OverflowError):
            raise _Wrong(value, expected) from None
        # An empty list is an array of floats; a mask over an array would be dropped unseen.
        if array.dtype.kind not in kinds or isinstance(value, np.ma.MaskedArray):
            raise _Wrong(value, expected)
        empty = filled and not array.size
        if empty or (shape is not None and not shape.fits(array.shape, sizes)):
            wanted = shape.told(sizes) if shape else ""
            raise _Wrong(array.shape, f"{what} {wanted}{filled}", " (its shape)")
        if array.dtype.kind == "f" and OPEN not in marks:
            # The first is False for NaN.
            small = np.abs(array) < _LARGEST if INFINITE not in marks else ~np.isnan(array)
            if not small.all():
                raise _Wrong(float(array[~small].flat[0]), expected)
        if not convert or MASK in marks:
            return value if not convert else array
        # One type for the kernels: another would be compiled anew, for seconds.
        usual = array.dtype == float and array.flags.c_contiguous and array.flags.writeable
        return array if usual and type(array) is np.ndarray else np.array(array, float, order="C")

    return Requirement(expected, accept)


def _container(origin: type, inner: tuple[Any, ...]) -> Requirement:
    if issubclass(origin, Mapping):
        return _mapping(requirement_of(inner[0]), requirement_of(inner[1]))
    if origin is tuple and not (len(inner) == 2 and inner[1] is ...):
        return _tuple([requirement_of(one) for one in inner])
    if origin is tuple or origin is list or origin in (Sequence, Collection):
        return _several(requirement_of(inner[0]), ordered=origin is not Collection)
    if origin is type:
        return _instance((type,), "a class")
    if origin is Callable:  # type: ignore[comparison-overlap]
        return Requirement("a function", _function)
    return _instance((origin,), f"a {origin.__name__}")


def _several(each: Requirement, ordered: bool) -> Requirement:
    expected = f"several of: {each.expected}"
    wanted = (Sequence, np.ndarray) if ordered else (Collection, np.ndarray)

    def accept(value: Any, sizes: dict[str, int]) -> Any:
        if not isinstance(value, wanted) or isinstance(value, str | bytes | Mapping):
            raise _Wrong(value, expected)
        if isinstance(value, np.ndarray) and value.ndim == 0:
            raise _Wrong(value, expected)
        for place, one in enumerate(value):
            _inside(each, one, f"[{place}]", sizes)
        return value

    return Requirement(expected, accept)


def _tuple(tests: list[Requirement]) -> Requirement:
    expected = "a tuple of " + ", ".join(test.expected for test in tests)

    def accept(value: Any, sizes: dict[str, int]) -> Any:
        if not isinstance(value, Sequence) or isinstance(value, str) or len(value) != len(tests):
            raise _Wrong(value, expected)
        for place, (test, one) in enumerate(zip(tests, value, strict=True)):
            _inside(test, one, f"[{place}]", sizes)
        return value

    return Requirement(expected, accept)


def _mapping(keys: Requirement, values: Requirement) -> Requirement:
    expected = f"a mapping of {keys.expected} to {values.expected}"

    def accept(value: Any, sizes: dict[str, int]) -> Any:
        if not isinstance(value, Mapping):
            raise _Wrong(value, expected)
        for key, one in value.items():
            _inside(keys, key, " (a key)", sizes)
            _inside(values, one, f"[{key!r}]", sizes)
        return value

    return Requirement(expected, accept)


def _inside(test: Requirement, value: Any, field: str, sizes: dict[str, int]) -> None:
    try:
        test.accept(value, sizes)
    except _Wrong as wrong:
        raise _Wrong(wrong.value, wrong.expected, field + wrong.field) from None


def _either(tests: list[Requirement]) -> Requirement:
    expected = ", or ".join(dict.fromkeys(test.expected for test in tests))

    def accept(value: Any, sizes: dict[str, int]) -> Any:
        wrong = None
        for test in tests:
            try:
                return test.accept(value, sizes)
            except _Wrong as found:
                wrong = wrong or found
        only = len([test for test in tests if test.expected != "None"]) == 1
        raise wrong if only and wrong else _Wrong(value, expected)

    return Requirement(
        expected, accept, unknown_name=all(t.unknown_name or t.expected == "None" for t in tests)
    )
