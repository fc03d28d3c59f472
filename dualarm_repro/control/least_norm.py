"""x = target + A^T (A A^T)^-1 (b - A target): the pseudo-inverse solution, by a Cholesky factor."""

from __future__ import annotations

from ..kernel import kernel
from .neural.saddle import solve_multipliers


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
    for i in range(m):
        multipliers[i] = b[i]
    solve_multipliers(A, target, multipliers)
    for k in range(n):
        total = target[k]
        for i in range(m):
            total -= A[i, k] * multipliers[i]
        x[k] = total
