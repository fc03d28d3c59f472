"""Every array that a public entry takes says which shape it has to have."""

import inspect
import sys
import typing

import numpy as np
import pytest
from entries import entries

from dualarm_repro.arguments import LATER, Shape, checked


def unshaped(kind):
    """Whether an array of any shape is somewhere in what an annotation asks for."""
    if typing.get_origin(kind) is typing.Annotated:
        inner, *marks = typing.get_args(kind)
        said = LATER in marks or any(isinstance(mark, Shape) for mark in marks)
        return not said and unshaped(inner)
    if kind is np.ndarray or typing.get_origin(kind) is np.ndarray:
        return True
    parts = typing.get_args(kind)
    takes = parts if typing.get_origin(kind) is not None and parts else ()
    called = typing.get_origin(kind) is __import__("collections").abc.Callable
    return not called and any(unshaped(one) for one in takes if not isinstance(one, list))


def without_shape(entry):
    """Names of the parameters of a checked entry that take an array of any shape."""
    thing = entry.plain
    thing = thing.__init__ if inspect.isclass(thing) else getattr(thing, "__func__", thing)
    if not hasattr(thing, "__wrapped__"):  # who checks its arguments in another way
        return []
    names, found = vars(sys.modules[thing.__module__]), []
    for name, parameter in inspect.signature(thing).parameters.items():
        kind = parameter.annotation
        try:
            kind = eval(kind, names) if isinstance(kind, str) else kind
        except NameError:  # imported for type checking only
            continue
        if unshaped(kind):
            found.append(name)
    return found
