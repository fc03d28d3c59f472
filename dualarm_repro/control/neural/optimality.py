"""Optimality conditions of the penalised problem and their Jacobian by the network state.

F(y) = [x - target + A^T l + C^T P'(C x - d);  A x - b],    y = [x; l]
M    = [I + C^T P''(C x - d) C,  A^T;  A,  0]

C x <= d holds the rows G x <= h and both joint bounds. F = 0 is the matrix equation E y = e with
E = [I A^T; A 0] and e = [target - C^T P'; b].
"""

from __future__ import annotations

from ...kernel import kernel
from .penalty import penalty


@kernel
def optimality(network, program, y, F):
    """F(y) (n + m,)."""
    target, A, b, G, h, lower, upper = program
    n, m = len(target), len(b)
    for i in range(n):
        F[i] = y[i] - target[i]
        F[i] += penalty(network.penalty, network.factor, network.sharpness, y[i] - upper[i])[1]
        F[i] -= penalty(network.penalty, network.factor, network.sharpness, lower[i] - y[i])[1]
    for k in range(m):
        total = -b[k]
        for i in range(n):
            total += A[k, i] * y[i]
            F[i] += A[k, i] * y[n + k]
        F[n + k] = total
    for k in range(len(h)):
        total = -h[k]
        for i in range(n):
            total += G[k, i] * y[i]
        push = penalty(network.penalty, network.factor, network.sharpness, total)[1]
        if push != 0.0:
            for i in range(n):
                F[i] += G[k, i] * push


@kernel
def penalised_hessian(network, program, y, H):
    """H = I + C^T P'' C (n, n), or the identity if the network does without."""
    _, _, _, G, h, lower, upper = program
    n = len(lower)
    H[:] = 0.0
    for i in range(n):
        H[i, i] = 1.0
        if network.hessian:
            H[i, i] += penalty(network.penalty, network.factor, network.sharpness, y[i] - upper[i])[
                2
            ]
            H[i, i] += penalty(network.penalty, network.factor, network.sharpness, lower[i] - y[i])[
                2
            ]
    if not network.hessian:
        return
    for k in range(len(h)):
        total = -h[k]
        for i in range(n):
            total += G[k, i] * y[i]
        bend = penalty(network.penalty, network.factor, network.sharpness, total)[2]
        if bend != 0.0:
            for i in range(n):
                scaled = bend * G[k, i]
                for j in range(i + 1):
                    H[i, j] += scaled * G[k, j]
    for i in range(n):
        for j in range(i):
            H[j, i] = H[i, j]
