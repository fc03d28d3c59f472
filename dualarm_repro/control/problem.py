"""The velocity problem as stated, its solution with the certificate it carries, and its failure."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Annotated

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import INFINITE, Shape, checked
from ..errors import DualArmError, InputError, shorten
from .parts import ProgramParts

#: Residual up to which a solution counts as certified.
CERTIFIED = 1e-8


@checked
@dataclass(frozen=True, eq=False)
class QuadraticProgram:
    """min 1/2 |x - target|^2  s.t.  A x = b,  G x <= h,  lower <= x <= upper.

    The velocity-level problem of a redundant arm (Whitney 1969 for the objective, Faverjon and
    Tournassoud 1987 for the inequalities): ``target`` 0 gives the least joint velocity.

    Attributes
    ----------
    target, lower, upper : ndarray (n,)
        [rad/s]; a bound may be infinite.
    A, b : ndarray (m, n), (m,)
        Task: [m/rad] and [m/s] for tip positions.
    G, h : ndarray (k, n), (k,)
        Inequalities.

    Raises
    ------
    InputError
        Shapes that do not fit, NaN, infinity other than in a bound, lower above upper.
    """

    target: Annotated[np.ndarray, Shape("n")]
    A: Annotated[np.ndarray, Shape("m", "n")]
    b: Annotated[np.ndarray, Shape("m")]
    G: Annotated[np.ndarray, Shape("k", "n")]
    h: Annotated[np.ndarray, Shape("k")]
    lower: Annotated[np.ndarray, INFINITE, Shape("n")]
    upper: Annotated[np.ndarray, INFINITE, Shape("n")]

    if TYPE_CHECKING:  # anything that makes an array is taken

        def __init__(
            self,
            target: ArrayLike,
            A: ArrayLike,
            b: ArrayLike,
            G: ArrayLike,
            h: ArrayLike,
            lower: ArrayLike,
            upper: ArrayLike,
        ) -> None: ...

    def __post_init__(self) -> None:
        if not (self.lower <= self.upper).all():
            worst = int(np.argmax(self.lower - self.upper))
            raise InputError(
                "QuadraticProgram",
                f"lower[{worst}]",
                float(self.lower[worst]),
                f"at most upper, {self.upper[worst]:g}",
            )

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return len(self.target)

    @property
    def parts(self) -> ProgramParts:
        """As the kernels take it."""
        return ProgramParts(*(getattr(self, name) for name in ProgramParts._fields))


@dataclass(frozen=True, eq=False)
class Solution:
    """A minimiser with its multipliers; the residuals certify it, whatever the solver claims.

    Lagrangian 1/2 |x - target|^2 + y.(A x - b) + z.(G x - h) + w.(x - bounds), z >= 0, w > 0 at an
    upper and w < 0 at a lower bound.

    Attributes
    ----------
    x, y, z, w : ndarray (n,), (m,), (k,), (n,)
    slack : ndarray (m,)
        What was taken off the task, A x = b - slack; zero unless the task had to yield.
    """

    problem: QuadraticProgram
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    w: np.ndarray
    slack: np.ndarray = field(default_factory=lambda: np.empty(0))

    def __post_init__(self) -> None:
        if not len(self.slack):
            object.__setattr__(self, "slack", np.zeros_like(self.problem.b))

    @cached_property
    def primal_residual(self) -> float:
        """Largest violation of a constraint."""
        p = self.problem
        return float(
            max(
                np.abs(p.A @ self.x + self.slack - p.b).max(initial=0.0),
                (p.G @ self.x - p.h).max(initial=0.0),
                (p.lower - self.x).max(initial=0.0),
                (self.x - p.upper).max(initial=0.0),
            )
        )

    @cached_property
    def dual_residual(self) -> float:
        """Largest entry of the gradient of the Lagrangian, or of a multiplier of the wrong sign."""
        p = self.problem
        gradient = self.x - p.target + p.A.T @ self.y + p.G.T @ self.z + self.w
        return float(max(np.abs(gradient).max(initial=0.0), (-self.z).max(initial=0.0)))

    @cached_property
    def gap(self) -> float:
        """Largest product of a multiplier and the slack of its inequality."""
        p = self.problem
        up, down = np.maximum(self.w, 0.0), np.maximum(-self.w, 0.0)
        products = [
            self.z * (p.G @ self.x - p.h),
            _product(up, p.upper - self.x),
            _product(down, self.x - p.lower),
        ]
        return float(np.abs(np.concatenate(products)).max(initial=0.0))

    @property
    def residual(self) -> float:
        """The largest of the three, the last two by the size of the multipliers; NaN if any is."""
        size = 1.0 + np.abs(np.concatenate([self.y, self.z, self.w])).max()
        return float(np.max([self.primal_residual, self.dual_residual / size, self.gap / size]))

    @checked
    def certified(self, tolerance: float = CERTIFIED) -> bool:
        """Whether the solution satisfies the optimality conditions to ``tolerance``."""
        return self.residual <= tolerance


class NoSolution(DualArmError):
    """No point satisfies the constraints, or none could be certified; keeps the problem."""

    def __init__(self, source: str, problem: QuadraticProgram, reason: str) -> None:
        self.source, self.problem, self.reason = source, problem, reason
        size = (
            f"{problem.size} unknowns, {len(problem.b)} equalities, {len(problem.h)} inequalities"
        )
        super().__init__(f"{source}: problem = {size}: expected a solution, {shorten(reason)}")


def _product(multiplier: np.ndarray, distance: np.ndarray) -> np.ndarray:
    """Products that are zero where the multiplier is, also at an infinite bound."""
    return multiplier * np.where(multiplier > 0, distance, 0.0)
