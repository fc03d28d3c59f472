"""Whether a run that stands still is held there: in a minimum of the potential, on either side.

A potential of distances has a continuous gradient whose derivative jumps where the nearest place of
an obstacle leaves a face for an edge. A difference over both sides averages what differs there, so
that a point that is held on one side only looks like a saddle or like a minimum by chance.
"""

from __future__ import annotations

import numpy as np

from ..descent.certificate import hessian
from ..descent.problem import PlanningProblem

#: Displacement of a one-sided difference [rad].
_DIFFERENCE = 1e-3
#: Curvature that counts as zero, as a share of the largest: along the joints that leave the flange
#: in place a potential of its position has none.
FLAT = 1e-3


def smallest_one_sided_curvature(made: PlanningProblem, q: np.ndarray, step: int) -> float:
    """Smallest of (g(q + h v) - g(q)) . v / h over the directions v, as a share of the largest.

    g = d(U_att + U_rep)/dq; v runs through both signs of the joint axes and of the eigenvectors of
    the second derivatives, so that either side of a jump is looked at by itself.

    Parameters
    ----------
    q : (nq,)
        Where a run stands still [rad].
    step
        The obstacles are those of this step.
    """
    _, vectors = np.linalg.eigh(hessian(made, q, step))
    lines = np.vstack([vectors.T, np.eye(len(q))])
    here = made.field.gradient(q, step)
    curvatures = [
        (made.field.gradient(q + _DIFFERENCE * v, step) - here) @ v / _DIFFERENCE
        for v in np.vstack([lines, -lines])
    ]
    return float(min(curvatures) / max(np.abs(curvatures)))


def held(made: PlanningProblem, last: np.ndarray, flat: np.ndarray) -> np.ndarray:
    """Which runs stand still in a true minimum, obstacles at rest, (N,) of bool.

    The gradient vanishes, and no one-sided second derivative is negative.

    Parameters
    ----------
    last : (N, nq)
        Where the runs stand still [rad].
    flat : (N,) of bool
        Where the gradient is known to vanish, see :func:`.stuck.stationary`.
    """
    rest = len(made.obstacles.cores) - 1
    found = flat.copy()
    for k in np.flatnonzero(flat):
        found[k] = smallest_one_sided_curvature(made, last[k], rest) >= -FLAT
    return found
