"""Arguments of public functions and classes, checked against their annotations at the entry.

``float`` and ``int`` are finite numbers, an array holds finite real numbers, a choice is one of its
names, and everything else is an instance of what is asked for. ``Annotated`` says more: bounds of
``pydantic.Field``, the :class:`Shape` of an array, :data:`FILLED` if it must not be empty,
:data:`INFINITE` where infinity and :data:`OPEN` where NaN as well has a meaning. What is wrong
becomes one line of an :class:`.InputError` that names function and argument.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable
from functools import wraps
from typing import Annotated, Any, TypeVar

import numpy as np
from pydantic import Field

from .annotation import (
    FILLED,
    INFINITE,
    LATER,
    MASK,
    OPEN,
    Requirement,
    Shape,
    requirement_of,
)
from .settings import Positive

__all__ = [
    "FILLED",
    "INFINITE",
    "LATER",
    "MASK",
    "OPEN",
    "Cloud",
    "Count",
    "JointRows",
    "Joints",
    "NonNegative",
    "Number",
    "Positive",
    "Rows3",
    "Seed",
    "Shape",
    "Vector3",
    "checked",
]

#: Most things that are made at once: beyond, memory ends before an answer comes.
MOST = 10_000_000

NonNegative = Annotated[float, Field(ge=0)]
Count = Annotated[int, Field(ge=1, le=MOST)]
#: As many, or none.
Number = Annotated[int, Field(ge=0, le=MOST)]
Seed = Annotated[int, Field(ge=0)]
#: Vectors (N, 3), and one (3,).
Rows3 = Annotated[np.ndarray, Shape("N", 3)]
Vector3 = Annotated[np.ndarray, Shape(3)]
#: Vectors (N, 3), at least one.
Cloud = Annotated[np.ndarray, Shape("N", 3), FILLED]
#: One configuration (n,), and one or rows of them (N, n).
Joints = Annotated[np.ndarray, Shape("n")]
JointRows = Annotated[np.ndarray, Shape(..., "n")]

_Entry = TypeVar("_Entry", bound=Callable[..., Any])


_OTHERS = "**"  # stands for keyword arguments of any name


def checked(entry: _Entry) -> _Entry:
    """The same function, or class, that refuses arguments which do not fit its annotations.

    Of a class these are the arguments of its construction. The annotations are read at the first
    call. An annotation that is not known at run time is not checked, nor is a plain ``ArrayLike``:
    who takes it checks it, by :func:`.real_array`.

    Raises
    ------
    InputError
        By the returned function: the first argument that does not fit.
    """
    if isinstance(entry, type):
        entry.__init__ = _guarded(entry.__init__, entry.__name__)  # type: ignore[misc]
        return entry
    return _guarded(entry, entry.__qualname__)


def _guarded(function: Any, source: str) -> Any:
    wanted: dict[str, Requirement] = {}

    @wraps(function)
    def guarded(*args: Any, **kwargs: Any) -> Any:
        if not wanted:
            wanted.update(_requirements(function))
        sizes: dict[str, int] = {}
        given = list(args)
        for place, (name, one) in enumerate(zip(wanted, args, strict=False)):
            given[place] = wanted[name].checked(source, name, one, sizes)
        for name, one in kwargs.items():
            if (need := wanted.get(name, wanted.get(_OTHERS))) is not None:
                kwargs[name] = need.checked(source, name, one, sizes)
        return function(*given, **kwargs)

    return guarded


def _requirements(function: Any) -> dict[str, Requirement]:
    """What each parameter has to be, in their order; ``self`` and ``cls`` anything."""
    names = vars(sys.modules[function.__module__])
    found: dict[str, Requirement] = {}
    for name, parameter in inspect.signature(function).parameters.items():
        if parameter.kind is parameter.VAR_POSITIONAL:
            break
        kind: Any = parameter.annotation
        if kind is parameter.empty:
            kind = Any
        if isinstance(kind, str):
            try:
                kind = eval(kind, names)
            except NameError:  # imported for type checking only
                kind = Any
        found[_OTHERS if parameter.kind is parameter.VAR_KEYWORD else name] = requirement_of(kind)
    return found
