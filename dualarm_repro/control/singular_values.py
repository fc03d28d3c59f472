"""x = target + A^+ (b - A target) by singular values: A^T V = U S with orthogonal columns of U S.

Plane rotations of pairs of columns make them orthogonal, one-sided Jacobi (Demmel and Veselic,
Jacobi's method is more accurate than QR, SIAM J. Matrix Anal. Appl. 13, 1992). Libraries compute a
pseudo-inverse by singular values, since these tell how near to singular A is.
"""

from __future__ import annotations

import numpy as np

from ..kernel import kernel

_SWEEPS = 30
_ORTHOGONAL = 1e-15  # cosine of two columns that are left as they are


@kernel
def rotate(M, i, j, cosine, sine):
    """Turn columns i and j of ``M`` by an angle, in place."""
    for k in range(len(M)):
        first = M[k, i]
        M[k, i] = cosine * first - sine * M[k, j]
        M[k, j] = sine * first + cosine * M[k, j]


@kernel
def least_norm_by_singular_values(target, A, b, x):
    """Minimiser of 1/2 |x - target|^2 under A x = b.

    Parameters
    ----------
    target, A, b : (n,), (m, n), (m,)
        The rows of A do not depend on each other.
    x : (n,), output
    """
    m, n = A.shape
    U, V = A.T.copy(), np.eye(m)
    turned, sweep = True, 0
    while turned and sweep < _SWEEPS:
        turned, sweep = False, sweep + 1
        for i in range(m - 1):
            for j in range(i + 1, m):
                first, second, product = 0.0, 0.0, 0.0
                for k in range(n):
                    first += U[k, i] * U[k, i]
                    second += U[k, j] * U[k, j]
                    product += U[k, i] * U[k, j]
                if abs(product) > _ORTHOGONAL * np.sqrt(first * second):
                    turned = True
                    ratio = (second - first) / (2.0 * product)
                    sign = 1.0 if ratio >= 0.0 else -1.0
                    tangent = sign / (abs(ratio) + np.sqrt(1.0 + ratio * ratio))
                    cosine = 1.0 / np.sqrt(1.0 + tangent * tangent)
                    rotate(U, i, j, cosine, cosine * tangent)
                    rotate(V, i, j, cosine, cosine * tangent)
    rest = np.empty(m)
    for i in range(m):
        rest[i] = b[i]
        for k in range(n):
            rest[i] -= A[i, k] * target[k]
    for k in range(n):
        x[k] = target[k]
    for i in range(m):
        square, share = 0.0, 0.0
        for k in range(n):
            square += U[k, i] * U[k, i]
        for k in range(m):
            share += V[k, i] * rest[k]
        share = share / square
        for k in range(n):
            x[k] += share * U[k, i]
