"""Whether a run that stands still is held there: by a vanishing gradient, and against pushes.

A descent also halts on a crease of the potential, or crawls; and where the gradient vanishes it may
be that of a saddle, on which nothing but the lack of a push holds an arm.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.optimize import minimize

from ..descent.batch import plan_batch
from ..descent.problem import PlanningProblem, problem
from ..descent.termination import within
from .runs import touching

#: |dU/dq| up to which a configuration counts as stationary, where that along a path is about ten.
STATIONARY = 1e-3
#: Joint distance within which a stationary point counts as that of a run [rad].
_NEAR = 0.1
_POLISH = 100  # iterations
#: Size of a push [rad], how many there are, and the share of the motion that counts as rest of any
#: other run after it: a saddle is left slowly.
PUSH = 1e-3
_PUSHES = 8
_PATIENCE = 1e-3


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
        end = minimize(
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


def held(made: PlanningProblem, last: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Which runs do not arrive after any of some small pushes either, obstacles at rest (N,).

    Each joint is pushed by up to PUSH, which draws away what rests on a saddle or on the rim of a
    valley.

    Parameters
    ----------
    last : (N, nq)
        Where the runs stand still [rad].
    """
    found = np.zeros(len(last), dtype=bool)
    if not len(last):
        return found
    resting = made.obstacles
    resting = replace(resting, cores=resting.cores[-1:], boxes=resting.boxes[-1:])
    end = made.settings.termination
    trap = end.trap.changed(threshold=_PATIENCE * end.trap.threshold)
    settings = made.settings.changed(termination=end.changed(trap=trap))
    at_rest = problem(made.placed, made.start, made.goal, resting, settings)
    for k, q in enumerate(last):
        pushed = q + rng.uniform(-PUSH, PUSH, (_PUSHES, len(q)))
        clear = ~touching(at_rest, pushed)
        runs = clear.any() and plan_batch(made.placed, pushed[clear], made.goal, resting, settings)
        found[k] = not (runs and runs.reached.any())
    return found
