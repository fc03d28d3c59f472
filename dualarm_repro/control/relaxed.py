"""The problem with a task that may yield: safety goes before tracking."""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from .least_distance import least_distance
from .parts import ProgramParts


@kernel
def least_distance_with_slack(program, weight):
    """min 1/2 |x - target|^2 + weight/2 |s|^2  s.t.  A x + s = b, G x <= h, lower <= x <= upper.

    With s = s' / sqrt(weight) it is a least-distance problem in (x, s'). Inequalities never yield.

    Returns
    -------
    status, x, y, z, w, s
        ``s`` (m,) is what the task gives up.
    """
    target, A, b, G, h, lower, upper = program
    n, m, k = len(target), len(b), len(h)
    root = np.sqrt(weight)
    wide_target, wide_A, wide_G = np.zeros(n + m), np.zeros((m, n + m)), np.zeros((k, n + m))
    wide_lower, wide_upper = np.full(n + m, -np.inf), np.full(n + m, np.inf)
    wide_target[:n], wide_A[:, :n], wide_G[:, :n] = target, A, G
    wide_lower[:n], wide_upper[:n] = lower, upper
    for i in range(m):
        wide_A[i, n + i] = 1.0 / root
    wide = ProgramParts(wide_target, wide_A, b, wide_G, h, wide_lower, wide_upper)
    status, x, y, z, w = least_distance(wide)
    return status, x[:n].copy(), y, z, w[:n].copy(), x[n:] / root
