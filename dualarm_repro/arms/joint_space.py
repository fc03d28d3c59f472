"""The space of the joint vectors of an arm: types, limits, random postures, differences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import Number, checked
from .joint_type import JointType
from .poses import check_configurations


class JointSpace:
    """Joint vectors q (nq,) of an arm.

    The unit of a joint is rad, of a prismatic joint m; so are those of its limits.

    Attributes
    ----------
    name : str
    nq : int
    types : tuple of JointType
        How each joint moves.
    lower, upper : ndarray (nq,)
        Joint limits [rad, m], infinite for a continuous joint.
    """

    def __init__(
        self, name: str, types: Sequence[JointType], lower: np.ndarray, upper: np.ndarray
    ) -> None:
        self.name, self.types, self.nq = name, tuple(types), len(lower)
        self.lower, self.upper = lower, upper

    @property
    def slides(self) -> np.ndarray:
        """Which joints are prismatic (nq,) of bool."""
        return np.array([kind is JointType.PRISMATIC for kind in self.types])

    @property
    def turns_for_ever(self) -> np.ndarray:
        """Which joints are continuous (nq,) of bool."""
        return np.array([kind is JointType.CONTINUOUS for kind in self.types])

    @checked
    def limits(self, enforced: bool = True) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper limits of the joints (nq,) [rad, m], infinite unless ``enforced``; those
        of a continuous joint always are."""
        if enforced:
            return self.lower, self.upper
        return np.full(self.nq, -np.inf), np.full(self.nq, np.inf)

    @property
    def usual_range(self) -> tuple[np.ndarray, np.ndarray]:
        """The limits, for a continuous joint -pi and pi: finite, and every posture is in it."""
        for_ever = self.turns_for_ever
        return np.where(for_ever, -np.pi, self.lower), np.where(for_ever, np.pi, self.upper)

    @checked
    def within_limits(self, q: ArrayLike, tolerance: float = 0.0) -> bool | np.ndarray:
        """Whether lower - tolerance <= q <= upper + tolerance [rad, m], bool or (N,) of bool."""
        q = self.configurations(q)
        inside: np.ndarray = (q >= self.lower - tolerance) & (q <= self.upper + tolerance)
        every: np.ndarray = np.all(inside, axis=-1)
        return bool(every) if q.ndim == 1 else every

    @checked
    def random_configurations(self, n: Number, rng: np.random.Generator) -> np.ndarray:
        """``n`` configurations, uniform within :attr:`usual_range`, (n, nq) [rad, m]."""
        lower, upper = self.usual_range
        q = rng.random((n, self.nq))
        q *= upper - lower
        q += lower
        return q

    @checked
    def difference(self, start: ArrayLike, end: ArrayLike) -> np.ndarray:
        """The shortest motion from one posture to another, end = start + difference.

        Of a continuous joint it is the turn of at most half a circle; there the end differs by full
        turns.

        Parameters
        ----------
        start, end : (nq,) or (N, nq) [rad, m]

        Returns
        -------
        ndarray (nq,) or (N, nq)
        """
        way = self.configurations(end) - self.configurations(start)
        short = way - 2.0 * np.pi * np.round(way / (2.0 * np.pi))
        return np.where(self.turns_for_ever, short, way)

    @checked
    def nearest(self, q: ArrayLike, reference: ArrayLike) -> np.ndarray:
        """The same posture with its continuous joints turned as near to ``reference`` as can be.

        A planner that takes it as goal goes the short way round. The other joints stay to the
        last digit.
        """
        q = self.configurations(q)
        turns = np.round((q - self.configurations(reference)) / (2.0 * np.pi))
        return np.where(self.turns_for_ever, q - 2.0 * np.pi * turns, q)

    @checked
    def distance(self, start: ArrayLike, end: ArrayLike) -> float | np.ndarray:
        """Euclidean length of :meth:`difference`, radians and metres counted alike."""
        length = np.linalg.norm(self.difference(start, end), axis=-1)
        return float(length) if length.ndim == 0 else length

    def configurations(self, q: ArrayLike) -> np.ndarray:
        """``q`` as a float64 array (nq,) or (N, nq).

        Raises
        ------
        ConfigurationError
            Wrong shape, NaN or infinity.
        """
        unit = "rad, m for prismatic joints" if self.slides.any() else "rad"
        expected = f"{self.nq} finite numbers [{unit}], or rows of {self.nq}"
        return check_configurations(f"arm {self.name}", q, self.nq, expected)
