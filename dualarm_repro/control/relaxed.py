"""The problem with a task that may yield: safety goes before tracking."""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from .least_distance import least_distance


@kernel
def least_distance_with_slack(v, A, b, G, h, lower, upper, weight):
    """min 1/2 |x - v|^2 + weight/2 |s|^2  s.t.  A x + s = b, G x <= h, lower <= x <= upper.

    With s = s' / sqrt(weight) it is a least-distance problem in (x, s'). Inequalities never yield.

    Returns
    -------
    status, x, y, z, w, s
        ``s`` (m,) is what the task gives up.
    """
    n, m, k = len(v), len(b), len(h)
    root = np.sqrt(weight)
    wide_v, wide_A, wide_G = np.zeros(n + m), np.zeros((m, n + m)), np.zeros((k, n + m))
    wide_lower, wide_upper = np.full(n + m, -np.inf), np.full(n + m, np.inf)
    wide_v[:n], wide_A[:, :n], wide_G[:, :n] = v, A, G
    wide_lower[:n], wide_upper[:n] = lower, upper
    for i in range(m):
        wide_A[i, n + i] = 1.0 / root
    status, x, y, z, w = least_distance(wide_v, wide_A, b, wide_G, h, wide_lower, wide_upper)
    return status, x[:n].copy(), y, z, w[:n].copy(), x[n:] / root
