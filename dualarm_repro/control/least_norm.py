"""x = target + A^T (A A^T)^-1 (b - A target): the pseudo-inverse solution, by a Cholesky factor."""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from .neural.saddle import backward, factorise, forward


@kernel
def least_norm(target, A, b, x, multipliers):
    """Minimiser of 1/2 |x - target|^2 under A x = b.

    Parameters
    ----------
    target, A, b : (n,), (m, n), (m,)
    x, multipliers : (n,), (m,), output
        x = target - A^T multipliers; NaN where the rows of A depend on each other.
    """
    m, n = A.shape
    S = np.empty((m, m))
    for i in range(m):
        total = -b[i]
        for k in range(n):
            total += A[i, k] * target[k]
        multipliers[i] = total
        for j in range(i + 1):
            total = 0.0
            for k in range(n):
                total += A[i, k] * A[j, k]
            S[i, j] = total
    factorise(S)
    forward(S, multipliers)
    backward(S, multipliers)
    for k in range(n):
        total = target[k]
        for i in range(m):
            total -= A[i, k] * multipliers[i]
        x[k] = total
