"""Whether a run that stands still does so where the gradient vanishes.

A descent also halts on a crease of the potential, or crawls. What holds an arm beyond that is the
business of :mod:`.held`.
"""

from __future__ import annotations

import numpy as np
import scipy

from ..descent.problem import PlanningProblem
from ..descent.termination import within

#: |dU/dq| up to which a configuration counts as stationary, where that along a path is about ten.
STATIONARY = 1e-3
#: Joint distance within which a stationary point counts as that of a run [rad].
_NEAR = 0.1
_POLISH = 100  # iterations


def stationary(made: PlanningProblem, last: np.ndarray, gradient: np.ndarray) -> np.ndarray:
    """Which runs end where d(U_att + U_rep)/dq = 0, obstacles at rest, (N,) of bool.

    That is certain where |dU/dq| <= STATIONARY. A run that still creeps when its motion is judged
    to have stopped lies next to such a point if a descent that may not leave its neighbourhood
    ends inside it, with a gradient that small and away from the goal.

    Parameters
    ----------
    last : (N, nq)
        Where the runs ended [rad].
    gradient : (N,)
        |dU/dq| there.
    """
    rest = len(made.obstacles.cores) - 1
    found = gradient <= STATIONARY
    for k in np.flatnonzero(~found):
        end = scipy.optimize.minimize(
            made.field.value,
            last[k],
            (rest,),
            jac=made.field.gradient,
            method="L-BFGS-B",
            bounds=np.column_stack([last[k] - _NEAR, last[k] + _NEAR]),
            options={"gtol": 0.1 * STATIONARY, "ftol": 0.0, "maxiter": _POLISH},
        ).x
        flat = np.linalg.norm(made.field.gradient(end, rest)) <= STATIONARY
        found[k] = flat and not within(*made.errors(end), *made.tolerances)
    return found
