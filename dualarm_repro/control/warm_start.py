"""An exact answer from the constraints that pressed the time before, if they still do.

Where the set of pressing constraints has not changed, the minimiser is that of a problem with these
as equalities. One least-norm solution finds it, and the optimality conditions say whether it is the
one: primal feasible, and no multiplier that pulls. Else the dual active-set method starts anew.
"""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from .least_distance import least_distance
from .least_norm import least_norm

_KEPT = 1e-12  # what a constraint may be violated by


@kernel
def least_distance_from(program, pressing, at_bound):
    """Minimiser as of :func:`.least_distance.least_distance`, tried from a set of constraints.

    Parameters
    ----------
    program : ProgramParts
    pressing : (k,) of bool
        Rows taken for equalities.
    at_bound : (n,) of int
        1 for a joint at its upper, -1 at its lower bound, else 0.

    Returns
    -------
    kept : bool
        Whether the set still was the one that presses.
    status, x, y, z, w
        As of :func:`.least_distance.least_distance`.
    """
    target, A, b, G, h, lower, upper = program
    n, m, k = len(target), len(b), len(h)
    rows = m + pressing.sum() + np.abs(at_bound).sum()
    y, z, w = np.zeros(m), np.zeros(k), np.zeros(n)
    if rows <= n:
        N, c, x, multipliers = np.zeros((rows, n)), np.empty(rows), np.empty(n), np.empty(rows)
        N[:m], c[:m], at = A, b, m
        for i in range(k):
            if pressing[i]:
                N[at], c[at], at = G[i], h[i], at + 1
        for i in range(n):
            if at_bound[i] != 0:
                N[at, i], c[at], at = 1.0, upper[i] if at_bound[i] > 0 else lower[i], at + 1
        least_norm(target, N, c, x, multipliers)
        y[:], at, right = multipliers[:m], m, True
        for i in range(k):
            if pressing[i]:
                z[i], at = multipliers[at], at + 1
                right = right and z[i] >= 0.0
            else:
                total = h[i]
                for j in range(n):
                    total -= G[i, j] * x[j]
                right = right and total >= -_KEPT
        for i in range(n):
            if at_bound[i] != 0:
                w[i], at = multipliers[at], at + 1
                right = right and w[i] * at_bound[i] >= 0.0
            else:
                right = right and lower[i] - _KEPT <= x[i] <= upper[i] + _KEPT
        if right:
            return True, 0, x, y, z, w
    status, x, y, z, w = least_distance(program)
    return False, status, x, y, z, w
