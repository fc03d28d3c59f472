"""Circles as tip paths: r(t) = c + R (cos s(t) u + sin s(t) v), run in one of two time laws."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from pydantic import Field

from ..arguments import Positive, Shape, checked
from ..errors import InputError
from ..kernel import kernel
from ..settings import choice, code

#: Vectors, one per arm.
Rows = Annotated[ArrayLike, Shape("A", 3)]
Turns = Annotated[ArrayLike, Shape("A")]


class TimeLaw(StrEnum):
    """How s runs from 0 to 2 pi."""

    REST_TO_REST = "rest_to_rest"
    CONSTANT_SPEED = "constant_speed"


_REST_TO_REST = code(TimeLaw.REST_TO_REST)


class CircleNumbers(NamedTuple):
    """``centre`` (A, 3), ``u``, ``v`` (A, 3) scaled by the radius, ``duration``, ``law``."""

    centre: np.ndarray
    u: np.ndarray
    v: np.ndarray
    duration: float
    law: int


@checked
@dataclass(frozen=True, eq=False)
class Circles:
    """One circle per arm, all run once in ``duration``.

    Attributes
    ----------
    centre : (A, 3) [m]
    u, v : (A, 3)
        Orthogonal, of the length of the radius [m]; the path starts at centre + u.
    duration : float [s]
    law : TimeLaw
        ``rest_to_rest``: s = 2 pi sin^2(pi t / (2 T)); ``constant_speed``: s = 2 pi t / T.

    Raises
    ------
    InputError
        NaN or infinity, wrong shapes, a duration that is not positive.
    UnknownNameError
        No such time law.
    """

    centre: Annotated[np.ndarray, Shape("A", 3)]
    u: Annotated[np.ndarray, Shape("A", 3)]
    v: Annotated[np.ndarray, Shape("A", 3)]
    duration: float = 10.0
    law: TimeLaw = TimeLaw.REST_TO_REST

    if TYPE_CHECKING:  # anything that makes an array is taken, and a law by its name

        def __init__(
            self,
            centre: ArrayLike,
            u: ArrayLike,
            v: ArrayLike,
            duration: float = 10.0,
            law: str = "rest_to_rest",
        ) -> None: ...

    def __post_init__(self) -> None:
        for name in ("centre", "u", "v"):
            object.__setattr__(self, name, getattr(self, name).copy())
        if not (np.isfinite(self.duration) and self.duration > 0):
            raise InputError("Circles", "duration", self.duration, "a positive time [s]")
        object.__setattr__(self, "law", choice(TimeLaw, "Circles", "law", self.law))

    @classmethod
    @checked
    def through(
        cls,
        tips: Rows,
        normals: Rows,
        angles: Annotated[ArrayLike, Shape("A")],
        radius: Positive,
        **timing: Any,
    ) -> Circles:
        """Circles that start at ``tips``, in planes normal to ``normals``.

        ``angles`` turn the direction from the tip to the centre within each plane.
        """
        n = np.asarray(normals, dtype=float)
        n = n / np.linalg.norm(n, axis=1, keepdims=True)
        # Any direction in the plane: the one from the axis that the normal is farthest from.
        axis = np.eye(3)[np.argmin(np.abs(n), axis=1)]
        e = np.cross(n, axis)
        e /= np.linalg.norm(e, axis=1, keepdims=True)
        turned = np.asarray(angles, dtype=float)[:, None]
        u = radius * (np.cos(turned) * e + np.sin(turned) * np.cross(n, e))
        return cls(np.asarray(tips, dtype=float) - u, u, np.cross(n, u), **timing)

    def numbers(self) -> CircleNumbers:
        """For the kernels."""
        return CircleNumbers(self.centre, self.u, self.v, float(self.duration), code(self.law))

    @checked
    def at(self, t: Annotated[float, Field(ge=-1e9, le=1e9)]) -> tuple[np.ndarray, np.ndarray]:
        """Positions and velocities (A, 3) at a time; it repeats every ``duration``."""
        position, velocity = np.empty_like(self.centre), np.empty_like(self.centre)
        follow(self.numbers(), float(t), position, velocity)
        return position, velocity


@kernel
def follow(circle, t, position, velocity):
    """r(t) and dr/dt (A, 3); the path repeats every ``duration``."""
    T = circle.duration
    turns = np.floor(t / T)
    if circle.law == _REST_TO_REST:
        phase = 0.5 * np.pi * (t - turns * T) / T
        s = 2.0 * np.pi * np.sin(phase) ** 2
        ds = 2.0 * np.pi * np.pi / T * np.sin(phase) * np.cos(phase)
    else:
        s, ds = 2.0 * np.pi * t / T, 2.0 * np.pi / T
    c, d = np.cos(s), np.sin(s)
    for arm in range(len(circle.centre)):
        for r in range(3):
            u, v = circle.u[arm, r], circle.v[arm, r]
            position[arm, r] = circle.centre[arm, r] + c * u + d * v
            velocity[arm, r] = ds * (c * v - d * u)
