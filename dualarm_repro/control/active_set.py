"""The factors N = L Q of the normals of active constraints, kept while these come and go.

N has a row per normal, L (n, n) is lower triangular and the rows of Q (n, n) are orthonormal: the
first ``count`` of them span the active normals, the others the directions that keep them.
Reflections skip what is zero and a row of the largest part is the pivot, so that the rows of
normals of two arms that have no joint in common do not mix. Q is as wide as n rounded up to a full
SIMD register: no loop along its rows has a remainder.
"""

from __future__ import annotations

import numpy as np

from ..kernel import kernel

REGISTER = 8  # numbers that a SIMD register holds


@kernel
def padded(n):
    """n rounded up to full registers."""
    return (n + REGISTER - 1) // REGISTER * REGISTER


@kernel
def row_dot(A, i, x, first, last):
    """A[i] . x over the entries first ... last - 1, as two sums that do not wait for each other."""
    p, q = 0.0, 0.0
    half = (last - first) // 2
    for j in range(first, first + half):
        p += A[i, j] * x[j]
        q += A[i, j + half] * x[j + half]
    if (last - first) % 2:
        p += A[i, last - 1] * x[last - 1]
    return p + q


@kernel
def primal_direction(a, first, last, Q, count, d, z):
    """d = Q a and z = Q_2^T d_2, the part of a normal outside the active span; returns |z|^2.

    The normal is zero but for the entries first ... last - 1.
    """
    n, width = Q.shape
    square = 0.0
    for i in range(width):
        z[i] = 0.0
    for j in range(count):
        d[j] = row_dot(Q, j, a, first, last)
    for j in range(count, n):
        part = row_dot(Q, j, a, first, last)
        d[j] = part
        if part != 0.0:
            square += part * part
            for i in range(width):
                z[i] += part * Q[j, i]
    return square


@kernel
def dual_direction(L, count, d, r):
    """L^T r = d_1: by how much the multipliers fall per unit of the new one."""
    for i in range(count):
        r[i] = d[i]
    for i in range(count - 1, -1, -1):
        r[i] /= L[i, i]
        for j in range(i):
            r[j] -= L[i, j] * r[i]


@kernel
def append_normal(Q, L, count, d, z, square):
    """Add the normal with this :func:`primal_direction` as last row of L.

    The reflection I - 2 v v^T / |v|^2 with v = d_2 - length e turns d_2 onto the row ``count`` of
    Q, where Q_2^T v = z - length Q[count]; ``d`` and ``z`` are overwritten.
    """
    n, width = Q.shape
    pivot = count
    for j in range(count + 1, n):
        if abs(d[j]) > abs(d[pivot]):
            pivot = j
    if pivot != count:
        d[count], d[pivot] = d[pivot], d[count]
        for i in range(width):
            Q[count, i], Q[pivot, i] = Q[pivot, i], Q[count, i]
    length = -np.sqrt(square) if d[count] > 0.0 else np.sqrt(square)
    for i in range(count):
        L[count, i] = d[i]
    L[count, count] = length
    d[count] -= length
    scale = -1.0 / (length * d[count])  # 2 / |v|^2
    for i in range(width):
        z[i] = scale * (z[i] - length * Q[count, i])
    for j in range(count, n):
        part = d[j]
        if part != 0.0:
            for i in range(width):
                Q[j, i] -= part * z[i]


@kernel
def remove_normal(Q, L, leaving, count, active, u):
    """Drop one active constraint and make L triangular again; returns the new count."""
    for j in range(leaving, count - 1):
        active[j] = active[j + 1]
        u[j] = u[j + 1]
        for i in range(j + 2):
            L[j, i] = L[j + 1, i]
    u[count - 1] = u[count]
    for j in range(leaving + 1, count):
        length = np.sqrt(L[j - 1, j - 1] * L[j - 1, j - 1] + L[j - 1, j] * L[j - 1, j])
        c, s = L[j - 1, j - 1] / length, L[j - 1, j] / length
        for i in range(j - 1, count - 1):
            p, q = L[i, j - 1], L[i, j]
            L[i, j - 1], L[i, j] = c * p + s * q, c * q - s * p
        for i in range(Q.shape[1]):
            p, q = Q[j - 1, i], Q[j, i]
            Q[j - 1, i], Q[j, i] = c * p + s * q, c * q - s * p
    return count - 1
