"""What a scene is made of has the right types, before anything is computed from it."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np

from ..errors import InputError
from .bodies import PlacedArm
from .moving import MovingArm, MovingShape


def check_arguments(
    arms: Any, obstacles: Any, moving: Any, floor: Any, exempt: Any, self_collision: Any
) -> None:
    """Check the arguments of :class:`.scene.Scene`; shapes are checked where they are sorted.

    Raises
    ------
    InputError
        Naming the argument, its value and what was expected.
    """
    if not _row(arms) or not all(isinstance(one, PlacedArm) for one in arms):
        raise _wrong("arms", arms, "a sequence of PlacedArm")
    if not isinstance(obstacles, Mapping):
        raise _wrong("obstacles", obstacles, "a mapping of name to a shape or several")
    if not isinstance(moving, Mapping):
        raise _wrong("moving", moving, "a mapping of name to MovingShape or MovingArm")
    for name, one in moving.items():
        if not isinstance(one, MovingShape | MovingArm):
            raise _wrong(f"moving {name}", one, "a MovingShape or MovingArm")
    for name in (*obstacles, *moving, *(one.name for one in arms)):
        if not isinstance(name, str):
            raise _wrong("name", name, "text")
    if floor is not None and not _number(floor):
        raise _wrong("floor", floor, "a finite height [m], or None")
    if not isinstance(exempt, Collection) or not all(map(_pair, exempt)):
        raise _wrong("exempt", exempt, "pairs of names")
    if not isinstance(self_collision, bool | np.bool_):
        raise _wrong("self_collision", self_collision, "True or False")


def _wrong(field: str, value: object, expected: str) -> InputError:
    return InputError("Scene", field, value, expected)


def _row(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str | bytes)


def _number(value: Any) -> bool:
    try:
        return np.ndim(value) == 0 and bool(np.isfinite(float(value)))
    except (TypeError, ValueError, OverflowError):
        return False


def _pair(value: Any) -> bool:
    return _row(value) and len(value) == 2 and all(isinstance(name, str) for name in value)
