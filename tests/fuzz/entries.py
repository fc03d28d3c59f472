"""The public functions, classes and methods of the rooms, found from what the rooms export."""

import enum
import importlib
import inspect
from dataclasses import dataclass

from pydantic import BaseModel
from valid import BY_NAME, INSTANCES, VALID, made

ROOMS = ("arms", "scene", "planning", "control", "welding")
#: What a method returns and nobody builds: the fields are those of the method that made it.
RECORDS = {
    *("planning.TaskFaults", "arms.Exclusion", "arms.Neighbours", "control.NoSolution"),
    *(
        "planning.Batch",
        "planning.Certificate",
        "planning.CoordinatedPlan",
        "planning.LinkClearance",
    ),
    *(
        "planning.Plan",
        "planning.TaskSet",
        "planning.Truth",
        "planning.Method",
        "planning.Obstacles",
    ),
    *("control.Motion", "control.Solution", "scene.Clearance", "arms.Occupancy", "arms.Arm"),
    *("welding.Evolution", "welding.Jobs", "welding.Seam", "welding.Trace"),
}


@dataclass(frozen=True)
class Entry:
    """A function, a class that is made, or a method of an object that is made for it."""

    name: str
    plain: object
    owner: str = ""

    @property
    def function(self):
        """What is called."""
        return getattr(made(self.owner), self.name.rpartition(".")[2]) if self.owner else self.plain

    def arguments(self):
        """Valid keyword arguments.

        Raises
        ------
        LookupError
            None are recorded for a parameter without a default.
        """
        if self.name in VALID:
            return VALID[self.name]()
        found = {}
        for name, parameter in _parameters(self.function).items():
            if name in BY_NAME:
                found[name] = BY_NAME[name]()
            elif parameter.default is parameter.empty:
                raise LookupError(f"tests/fuzz/valid.py has no value of {name} of {self.name}")
        return found


def entries():
    """Every public entry with at least one argument."""
    found = []
    for room in ROOMS:
        module = importlib.import_module(f"dualarm_repro.{room}")
        for name in module.__all__:
            found += _of(f"{room}.{name}", getattr(module, name))
    return found


def _of(name, thing):
    if inspect.isclass(thing):
        if issubclass(thing, enum.Enum) or getattr(thing, "_is_protocol", False):
            return []
        by_hand = not (issubclass(thing, BaseModel) or hasattr(thing, "_fields"))
        return ([Entry(name, thing)] if by_hand and name not in RECORDS else []) + _methods(
            name, thing
        )
    takes_something = callable(thing) and not hasattr(thing, "__args__")
    return [Entry(name, thing)] if takes_something and _parameters(thing) else []


def _parameters(thing):
    return inspect.signature(getattr(thing, "py_func", thing)).parameters


def _methods(name, cls):
    found = []
    for word in dir(cls):
        raw = inspect.getattr_static(cls, word)
        bound = isinstance(raw, classmethod | staticmethod)
        inner = raw.__func__ if bound else raw
        module = getattr(inner, "__module__", None) or ""
        if word.startswith("_") or not inspect.isfunction(inner) or "dualarm_repro" not in module:
            continue
        if module in ("dualarm_repro.settings", "dualarm_repro.datafiles"):
            continue
        if bound:
            found.append(Entry(f"{name}.{word}", getattr(cls, word)))
        elif len(inspect.signature(inner).parameters) > 1:
            found.append(Entry(f"{name}.{word}", inner, INSTANCES.get(name, name)))
    return found
