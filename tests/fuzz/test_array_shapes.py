"""Every array that a checked function takes says which shape it has to have."""

import importlib
import inspect
import pkgutil
import sys
import typing
from collections.abc import Callable

import numpy as np
import pytest
from entries import ROOMS

from dualarm_repro.arguments import LATER, Rows3, Shape, Vector3, checked


def unshaped(kind):
    """Whether an array of any shape is somewhere in what an annotation asks for."""
    origin, parts = typing.get_origin(kind), typing.get_args(kind)
    if origin is typing.Annotated:
        inner, *marks = parts
        said = LATER in marks or any(isinstance(mark, Shape) for mark in marks)
        return not said and unshaped(inner)
    if kind is np.ndarray or origin is np.ndarray:
        return True
    return origin is not Callable and any(map(unshaped, parts))


def without_shape(function):
    """Names of the parameters of a checked function, or class, that take an array of any shape."""
    function = function.__init__ if inspect.isclass(function) else function
    if not hasattr(function, "__wrapped__"):  # it checks its arguments itself, or takes none
        return []
    names, found = vars(sys.modules[function.__module__]), []
    for name, parameter in inspect.signature(function).parameters.items():
        kind = parameter.annotation
        try:
            kind = eval(kind, names) if isinstance(kind, str) else kind
        except NameError:  # imported for type checking only, and not checked at run time
            continue
        if unshaped(kind):
            found.append(name)
    return found


def functions_of(module):
    """The functions and classes that a module defines, and the functions of the classes."""
    for thing in vars(module).values():
        if getattr(thing, "__module__", None) != module.__name__:
            continue
        if inspect.isclass(thing):
            yield thing
            for inner in vars(thing).values():
                yield getattr(inner, "__func__", inner)
        elif inspect.isfunction(thing):
            yield thing


@pytest.mark.parametrize("room", ROOMS)
def test_every_array_has_a_shape(room):
    package = importlib.import_module(f"dualarm_repro.{room}")
    found, looked = {}, 0
    for one in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        for function in functions_of(importlib.import_module(one.name)):
            looked += 1
            if names := without_shape(function):
                found[f"{one.name}.{function.__qualname__}"] = names
    assert found == {}
    assert looked > 50


def test_an_array_of_any_shape_is_found():
    @checked
    def any_shape(a: np.ndarray, b: dict[str, np.ndarray], c: np.ndarray | None = None) -> None:
        """Takes three."""

    @checked
    def some_shape(a: Vector3, b: dict[str, Rows3], c: Callable[[np.ndarray], int]) -> None:
        """Takes two."""

    assert without_shape(any_shape) == ["a", "b", "c"]
    assert without_shape(some_shape) == []
