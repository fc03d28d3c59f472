"""Arms that share a workspace, compiled into the arrays that the control kernels read."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import checked
from ..errors import ConfigurationError, InputError
from ..scene.bodies import PlacedArm
from ..scene.posing import links_of
from ..scene.scene import Scene
from .motion import JointLimits


class SystemArrays(NamedTuple):
    """Constant data of A arms with n joints in all, C link capsules and P watched pairs.

    Attributes
    ----------
    rotation, translation : (n + A, 3, 3), (n + A, 3)
        C_0 ... C_nq of every arm one after the other, as in :class:`..arms.chain.Chain`.
    base : (A, 3, 4)
    start : (A + 1,)
        First joint of every arm, and n.
    frame, first, last : (C,)
        Frame that carries a capsule; the joints first ... last - 1 move it.
    local : (C, 2, 3)
        Ends of its core in that frame [m].
    radius : (C,)
    pairs : (P, 2)
    lower, upper, speed : (n,)
        Joint limits [rad], largest joint speeds [rad/s].
    """

    rotation: np.ndarray
    translation: np.ndarray
    base: np.ndarray
    start: np.ndarray
    frame: np.ndarray
    first: np.ndarray
    last: np.ndarray
    local: np.ndarray
    radius: np.ndarray
    pairs: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    speed: np.ndarray


@checked
@dataclass(frozen=True, eq=False)
class ArmSystem:
    """Controlled arms on their bases, every link watched against the links of the other arms.

    Parameters
    ----------
    arms : sequence of PlacedArm
    exempt : pairs of names
        Pairs that may touch, named as in :class:`..scene.scene.Scene`.
    self_collision : bool
        Whether links of one arm are watched against each other too.

    Raises
    ------
    InputError
        No arm, or a name given twice.
    UnknownNameError
        An exempt name that no body has.
    """

    arms: Sequence[PlacedArm]
    exempt: Collection[tuple[str, str]] = ()
    self_collision: bool = False

    def __post_init__(self) -> None:
        if not self.arms:
            raise InputError("ArmSystem", "arms", self.arms, "at least one arm")
        self.arrays  # noqa: B018  wrong arms shall fail here, not at the first step

    @cached_property
    def scene(self) -> Scene:
        """The same arms as a scene, with the same pairs in the same order."""
        return Scene(self.arms, exempt=self.exempt, self_collision=self.self_collision)

    @cached_property
    def arrays(self) -> SystemArrays:
        """What the kernels read."""
        arms = [placed.arm for placed in self.arms]
        start = np.cumsum([0, *(arm.nq for arm in arms)])
        links = [links_of(arm) for arm in arms]
        owner = np.concatenate([np.full(len(part.joint), a) for a, part in enumerate(links)])
        joint = np.concatenate([part.joint for part in links])
        # The rows of the links come first among the capsules of a scene, arm by arm.
        pairs = self.scene.pairs.rows["capsule"]
        return SystemArrays(
            np.concatenate([arm.chain.rotation for arm in arms]),
            np.concatenate([arm.chain.translation for arm in arms]),
            np.array([placed.placement.homogeneous[:3] for placed in self.arms]),
            start,
            start[owner] + owner + joint,
            start[owner],
            start[owner] + joint,
            np.concatenate([part.local for part in links]),
            np.concatenate([part.radius for part in links]),
            pairs,
            *(np.concatenate([getattr(arm, name) for arm in arms]) for name in _LIMITS),
        )

    @property
    def limits(self) -> JointLimits:
        """Joint ranges and speeds of all arms."""
        return JointLimits(self.arrays.lower, self.arrays.upper, self.arrays.speed)

    @property
    def nq(self) -> int:
        """Joints of all arms."""
        return int(self.arrays.start[-1])

    @checked
    def configuration(self, q: ArrayLike) -> np.ndarray:
        """``q`` as a float64 array (nq,).

        Raises
        ------
        ConfigurationError
            Wrong shape, NaN or infinity.
        """
        array = self.scene.configurations(q)
        if array.ndim != 1:
            raise ConfigurationError("ArmSystem", "shape of q", array.shape, f"({self.nq},)")
        return array

    @checked
    def tips(self, q: ArrayLike) -> np.ndarray:
        """Flange positions of all arms in the world (A, 3) [m]."""
        q = self.configuration(q)
        columns = np.split(q, self.arrays.start[1:-1])
        pairs = zip(self.arms, columns, strict=True)
        return np.array([p.placement.act(p.arm.fk(part)[:3, 3]) for p, part in pairs])


_LIMITS = ("lower", "upper", "velocity_limit")
