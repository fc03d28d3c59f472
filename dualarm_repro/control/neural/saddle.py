"""Linear systems [H A^T; A 0] z = f by two Cholesky factorisations, compiled.

H = L L^T, S = A H^-1 A^T = K K^T;  S l = A H^-1 f_1 - f_2,  x = H^-1 (f_1 - A^T l).
"""

from __future__ import annotations

import numpy as np

from ...kernel import kernel


@kernel
def factorise(M):
    """Lower Cholesky factor in place; NaN on the diagonal if M is not positive definite."""
    for i in range(len(M)):
        for j in range(i + 1):
            total = M[i, j]
            for k in range(j):
                total -= M[i, k] * M[j, k]
            M[i, j] = np.sqrt(total) if i == j else total / M[j, j]


@kernel
def forward(L, v):
    """L^-1 v in place."""
    for i in range(len(v)):
        total = v[i]
        for k in range(i):
            total -= L[i, k] * v[k]
        v[i] = total / L[i, i]


@kernel
def backward(L, v):
    """L^-T v in place."""
    for i in range(len(v) - 1, -1, -1):
        total = v[i]
        for k in range(i + 1, len(v)):
            total -= L[k, i] * v[k]
        v[i] = total / L[i, i]


@kernel
def solve_multipliers(B, x, multiplier):
    """Solution of B B^T l = B x - b in place of b, ``multiplier`` (m,)."""
    m, n = B.shape
    S = np.empty((m, m))
    for i in range(m):
        total = -multiplier[i]
        for k in range(n):
            total += B[i, k] * x[k]
        multiplier[i] = total
        for j in range(i + 1):
            total = 0.0
            for k in range(n):
                total += B[i, k] * B[j, k]
            S[i, j] = total
    factorise(S)
    forward(S, multiplier)
    backward(S, multiplier)


@kernel
def solve_saddle(H, A, f):
    """Solution in place of ``f`` (n + m,); ``H`` (n, n) is overwritten by its factor."""
    m, n = A.shape
    factorise(H)
    B = A.copy()  # rows L^-1 A_k
    for k in range(m):
        forward(H, B[k])
    x, multiplier = f[:n], f[n:]
    forward(H, x)
    solve_multipliers(B, x, multiplier)
    for i in range(m):
        for k in range(n):
            x[k] -= B[i, k] * multiplier[i]
    backward(H, x)
