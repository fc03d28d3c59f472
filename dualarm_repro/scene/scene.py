"""A scene: arms on their bases, obstacles that stand, lie below or move, and pairs left out."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from ..arms.arm import Arm
from ..errors import ConfigurationError, InputError, UnknownNameError
from .distance import Shape
from .moving import JointPath, MovingArm, MovingShape
from .pairs import Pairs, find_pairs
from .shapes import HalfSpace

FLOOR = "floor"


@dataclass(frozen=True, eq=False)
class PlacedArm:
    """A controlled arm, the pose of its base in the world and, for a planner, start and goal [rad]."""

    name: str
    arm: Arm
    placement: pin.SE3 = field(default_factory=pin.SE3.Identity)
    start: np.ndarray | None = None
    goal: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class Scene:
    """Everything that has a place in one world frame.

    Attributes
    ----------
    arms : sequence of PlacedArm
        Controlled arms; q of the scene is their joint vectors one after the other.
    obstacles : mapping
        Name to a shape, or to several, such as the bars of a window: ``name/0``, ``name/1`` ...
    moving : mapping
        Name to a :class:`.moving.MovingShape` or :class:`.moving.MovingArm`.
    floor : float, optional
        Height [m] of a floor, an obstacle named ``floor``.
    exempt : pairs of names
        Pairs that may touch. A name is a body (``left/capsule_2``) or all bodies of an owner.
    self_collision : bool
        Whether bodies of one arm are paired with each other.

    Raises
    ------
    InputError
        No arm, a name given twice or with a slash, an exempt pair of unknown names.
    """

    arms: Sequence[PlacedArm]
    obstacles: Mapping[str, Shape | Sequence[Shape]] = field(default_factory=dict)
    moving: Mapping[str, MovingShape | MovingArm] = field(default_factory=dict)
    floor: float | None = None
    exempt: Collection[tuple[str, str]] = ()
    self_collision: bool = True

    def __post_init__(self) -> None:
        names = [*(placed.name for placed in self.arms), *self.obstacles, *self.moving]
        if self.floor is not None:
            names.append(FLOOR)
        for name in names:
            if names.count(name) > 1 or not name or "/" in name:
                raise InputError("Scene", "name", name, "distinct names without a slash")
        if not self.arms:
            raise InputError("Scene", "arms", self.arms, "at least one arm")
        self.pairs  # noqa: B018 - unknown exempt names are an error now, not at the first query

    @property
    def nq(self) -> int:
        """Length of q: the joints of all controlled arms."""
        return sum(placed.arm.nq for placed in self.arms)

    @cached_property
    def columns(self) -> dict[str, slice]:
        """Which entries of q belong to which arm."""
        ends = np.cumsum([placed.arm.nq for placed in self.arms]).tolist()
        starts = [0, *ends[:-1]]
        return {
            placed.name: slice(start, end)
            for placed, start, end in zip(self.arms, starts, ends, strict=True)
        }

    @cached_property
    def solids(self) -> dict[str, tuple[Shape, ...]]:
        """Standing obstacles with the floor, each as a tuple of shapes."""
        shapes = dict(self.obstacles)
        if self.floor is not None:
            shapes[FLOOR] = HalfSpace((0.0, 0.0, 1.0), self.floor)
        return {
            name: tuple(shape) if isinstance(shape, Sequence) else (shape,)
            for name, shape in shapes.items()
        }

    @cached_property
    def pairs(self) -> Pairs:
        """Bodies of the scene and the pairs whose distance is watched."""
        return find_pairs(self)
