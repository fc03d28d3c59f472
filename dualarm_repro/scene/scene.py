"""A scene: arms on their bases, obstacles that stand, lie below or move, and pairs left out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import LATER, checked
from ..arms.arm import Arm
from ..arms.poses import check_configurations
from ..errors import ConfigurationError, InputError, UnknownNameError
from .bodies import Bodies, PlacedArm, Shape, collect
from .moving import JointPath, MovingArm, MovingShape
from .pairs import Pairs, find_pairs
from .scene_arguments import check_arguments
from .shapes import HalfSpace

FLOOR = "floor"
_TWO_TURNS = 2.0 * np.pi


@checked
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
        Pairs that may touch. A name is a body (``left/capsule_2``), a link or shape of an arm
        (``left/forearm_link``), or all bodies of an owner.
    self_collision : bool
        Whether links of one arm are watched against each other.

    Raises
    ------
    InputError
        No arm, a name given twice or with a slash, an argument of the wrong type.
    UnknownNameError
        An exempt name that no body has.
    """

    arms: Sequence[PlacedArm]
    obstacles: Annotated[Mapping[str, Shape | Sequence[Shape]], LATER] = field(default_factory=dict)
    moving: Mapping[str, MovingShape | MovingArm] = field(default_factory=dict)
    floor: float | None = None
    exempt: Collection[tuple[str, str]] = ()
    self_collision: bool = True
    bodies: Bodies = field(init=False, repr=False)
    pairs: Pairs = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_arguments(
            self.arms, self.obstacles, self.moving, self.floor, self.exempt, self.self_collision
        )
        solids = dict(self.obstacles)
        names = [*(placed.name for placed in self.arms), *solids, *self.moving]
        if self.floor is not None:
            names.append(FLOOR)
            solids[FLOOR] = HalfSpace((0.0, 0.0, 1.0), self.floor)
        times = Counter(names)
        for name in names:
            if not isinstance(name, str) or times[name] > 1 or not name or "/" in name:
                raise InputError("Scene", "name", name, "distinct names without a slash")
        if not self.arms:
            raise InputError("Scene", "arms", self.arms, "at least one arm")
        bodies = collect(
            self.arms,
            {n: tuple(s) if isinstance(s, Sequence) else (s,) for n, s in solids.items()},
            self.moving,
        )
        object.__setattr__(self, "bodies", bodies)
        pairs = find_pairs(bodies, self.arms, self.exempt, self.self_collision)
        object.__setattr__(self, "pairs", pairs)

    @property
    def nq(self) -> int:
        """Length of q: the joints of all controlled arms."""
        return sum(placed.arm.nq for placed in self.arms)

    @cached_property
    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper limits of the joints of all controlled arms (nq,) [rad, m]; those of a
        continuous joint are two turns apart, which holds the short way between any two angles."""
        lower, upper = zip(*(_finite(placed.arm) for placed in self.arms), strict=True)
        return np.concatenate(lower), np.concatenate(upper)

    @cached_property
    def columns(self) -> dict[str, slice]:
        """Which entries of q belong to which arm."""
        ends = np.cumsum([placed.arm.nq for placed in self.arms]).tolist()
        return {
            placed.name: slice(end - placed.arm.nq, end)
            for placed, end in zip(self.arms, ends, strict=True)
        }

    @cached_property
    def support(self) -> np.ndarray:
        """(P, nq): +1 where a joint moves only the second body of a pair, -1 only the first."""
        sign = np.zeros((len(self.pairs), self.nq))
        for row, pair in zip(sign, self.pairs.bodies, strict=True):
            for body, value in zip(pair, (-1.0, 1.0), strict=True):
                if body.joint is not None:
                    start = self.columns[body.owner].start
                    row[start : start + body.joint] += value
        return sign

    @checked
    def stack(self, **q: ArrayLike) -> np.ndarray:
        """Joint vectors of all arms, given by name, as one q: (nq,), or (N, nq) from rows.

        Raises
        ------
        UnknownNameError
            An arm is missing, or none has the name.
        ConfigurationError
            Wrong shape, NaN or infinity.
        """
        if set(q) != set(self.columns):
            raise UnknownNameError("scene", "arms", sorted(q), f"all of {', '.join(self.columns)}")
        parts = [placed.arm.configurations(q[placed.name]) for placed in self.arms]
        lengths = [part.shape[:-1] for part in parts]
        if len(set(lengths)) > 1:
            raise ConfigurationError("scene", "rows of the arms", lengths, "as many for each arm")
        return np.concatenate(parts, axis=-1)

    @checked
    def configurations(self, q: ArrayLike) -> np.ndarray:
        """``q`` as a float64 array (nq,) or (N, nq).

        Raises
        ------
        ConfigurationError
            Wrong shape, NaN or infinity.
        """
        expected = f"{self.nq} finite numbers [rad] for {', '.join(self.columns)}, or rows of them"
        return check_configurations("scene", q, self.nq, expected)

    @checked
    def replaying(self, name: str, path: JointPath) -> Scene:
        """The same scene with one controlled arm turned into an obstacle that follows ``path``.

        Raises
        ------
        UnknownNameError
            No controlled arm has the name.
        """
        if name not in self.columns:
            raise UnknownNameError("scene", "arm", name, f"one of {', '.join(self.columns)}")
        placed = next(placed for placed in self.arms if placed.name == name)
        return replace(
            self,
            arms=[other for other in self.arms if other is not placed],
            moving={**self.moving, name: MovingArm(placed.arm, path, placed.placement)},
        )


def _finite(arm: Arm) -> tuple[np.ndarray, np.ndarray]:
    """The limits, those of continuous joints -2 pi and 2 pi."""
    for_ever, (lower, upper) = arm.turns_for_ever, arm.limits()
    return np.where(for_ever, -_TWO_TURNS, lower), np.where(for_ever, _TWO_TURNS, upper)
