"""Proof of where a plan that did not arrive came to rest: in a minimum, on a crease, on its way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arguments import Joints, Number, checked
from ...differences import central_differences
from .problem import PlanningProblem

# Displacement [rad] of the central differences; balances their two errors for smooth gradients.
_DIFFERENCE = 1e-5


@dataclass(frozen=True)
class Certificate:
    """The field U_att + U_rep, without a virtual point, where a plan ended.

    A minimum has a gradient near zero and no negative curvature; where a nearest distance switches
    (a crease) a descent stands although the gradient is large.

    Attributes
    ----------
    gradient_norm : float
        |dU/dq|, over the joints that no limit holds.
    smallest_curvature : float
        Smallest eigenvalue of the second derivatives, by central differences of the gradient.
    acting : tuple of str
        Shapes that repel there.
    joint_error : float
        max_j |q_j - q_gj| [rad].
    position_error : float
        |X - X_g| [m].
    """

    gradient_norm: float
    smallest_curvature: float
    acting: tuple[str, ...]
    joint_error: float
    position_error: float


@checked
def certify(made: PlanningProblem, q: Joints, step: Number) -> Certificate:
    """Gradient and curvature of U_att + U_rep at ``q``, with the obstacles of ``step``."""
    gradient = made.field.gradient(q, step)
    lower, upper = made.limits
    free = ~((q <= lower) & (gradient > 0) | (q >= upper) & (gradient < 0))
    curvature = hessian(made, q, step)[np.ix_(free, free)]
    return Certificate(
        float(np.linalg.norm(gradient[free])),
        float(np.linalg.eigvalsh(curvature).min(initial=np.inf)),
        made.repulsion.acting(q, step),
        *map(float, made.errors(q)),
    )


def hessian(made: PlanningProblem, q: np.ndarray, step: int) -> np.ndarray:
    """d^2 (U_att + U_rep) / dq^2 by central differences of the gradient, symmetrised (nq, nq)."""
    matrix = central_differences(lambda at: made.field.gradient(at, step), q, _DIFFERENCE)
    return 0.5 * (matrix + matrix.T)
