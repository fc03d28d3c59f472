"""Residual of a solution in compiled loops, the same number as ``Solution.residual``."""

from __future__ import annotations

import numpy as np

from ..kernel import kernel


@kernel
def residual(program, x, y, z, w):
    """Largest violation, gradient of the Lagrangian, wrong sign and complementarity product.

    All but the violation are taken by the size of the multipliers.
    """
    target, A, b, G, h, lower, upper = program
    violation, dual, size = 0.0, 0.0, 0.0
    gradient = np.empty(len(x))
    for i in range(len(x)):
        gradient[i] = x[i] - target[i] + w[i]
        low, high = x[i] - lower[i], upper[i] - x[i]
        violation = max(violation, -low, -high)
        size = max(size, abs(w[i]))
        if w[i] > 0.0:
            dual = max(dual, abs(w[i] * high))
        elif w[i] < 0.0:
            dual = max(dual, abs(w[i] * low))
    for k in range(len(b)):
        total = -b[k]
        for i in range(len(x)):
            total += A[k, i] * x[i]
            gradient[i] += A[k, i] * y[k]
        violation = max(violation, abs(total))
        size = max(size, abs(y[k]))
    for k in range(len(h)):
        total = -h[k]
        for i in range(len(x)):
            total += G[k, i] * x[i]
            gradient[i] += G[k, i] * z[k]
        violation = max(violation, total)
        dual = max(dual, -z[k], abs(z[k] * total))
        size = max(size, abs(z[k]))
    for i in range(len(x)):
        dual = max(dual, abs(gradient[i]))
        if np.isnan(gradient[i]):
            return np.inf
    return max(violation, dual / (1.0 + size))
