"""Minimiser under few constraints that are well apart, from their Gram matrix.

For a set of active constraints N x = c the minimiser of 1/2 |x - target|^2 is x = target + N^T u
with N N^T u = c - N target. Beginning with the equalities, the most violated inequality is made
active until none is violated. While no multiplier of an inequality falls below zero these are the
full steps of the dual method of :mod:`.least_distance`, at a fraction of the work; where one does,
or where a normal is nearly spanned by the active ones, that method has to decide.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..copies import copy_row
from ..kernel import kernel
from .least_distance import SOLVED, least_distance

_APART = 1e-6  # squared sine of a normal against the active span
_SETTLED = 1e-13  # violation of active constraints that is not refined
_FEASIBLE = 1e-12
_REFINEMENTS = 3  # of large numbers no more digits come, and the certificate decides
_REGISTER = 8  # numbers that a SIMD register holds


class Gram(NamedTuple):
    """Active normals and the Cholesky factor of their Gram matrix, L L^T = N N^T.

    ``N`` (n, W) and ``x`` (W,) are as wide as n rounded up to full registers, zero beyond n; ``L``
    (n, n); ``c``, ``v``, ``u`` (n,): right-hand sides, L^-1 (c - N target), multipliers; ``active``
    (n,): numbers of the constraints.
    """

    N: np.ndarray
    x: np.ndarray
    L: np.ndarray
    c: np.ndarray
    v: np.ndarray
    u: np.ndarray
    active: np.ndarray


@kernel
def make_gram(n):
    """Arrays for n unknowns."""
    width = (n + _REGISTER - 1) // _REGISTER * _REGISTER
    N, x, L = np.zeros((n, width)), np.zeros(width), np.empty((n, n))
    return Gram(N, x, L, np.empty(n), np.empty(n), np.empty(n), np.empty(n, np.int64))


class Work(NamedTuple):
    """Answer ``x`` (n,), multipliers ``y`` (m,), ``z`` (k,), ``w`` (n,), and what finds them.

    ``z`` is as long as the most rows there may be.
    """

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    w: np.ndarray
    gram: Gram


@kernel
def make_work(n, m, k):
    """Arrays for n unknowns, m equalities and at most k rows."""
    return Work(np.empty(n), np.empty(m), np.empty(k), np.empty(n), make_gram(n))


@kernel
def minimise(program, work):
    """:func:`.least_distance.least_distance` in given arrays; returns its status."""
    n, m, k = len(program.target), len(program.b), len(program.h)
    x, y, z, w, gram = work
    count = few_constraints(program, gram)
    if count < 0:
        status, unknowns, equalities, rows, bounds = least_distance(program)
        copy_row(unknowns, x)
        copy_row(equalities, y)
        copy_row(rows, z[:k])
        copy_row(bounds, w)
        return status
    copy_row(gram.x, x)
    y[:], z[:k], w[:] = 0.0, 0.0, 0.0
    for j in range(count):
        i, u = gram.active[j], gram.u[j]
        if i < m:
            y[i] = -u
        elif i < m + k:
            z[i - m] = u
        elif i < m + k + n:
            w[i - m - k] -= u
        else:
            w[i - m - k - n] += u
    return SOLVED


@kernel
def few_constraints(program, gram):
    """Minimiser and multipliers into ``gram``; returns how many constraints are active, or -1."""
    target, A, b, G, h, lower, upper = program
    N, x, L, c, v, u, active = gram
    n, m, k = len(target), len(b), len(h)
    for j in range(n):
        x[j] = target[j]
    for i in range(m):
        if i == n:
            return -1
        for j in range(n):
            N[i, j] = A[i, j]
        c[i], active[i] = b[i], i
        if not _append(N, L, x, c, v, i):
            return -1
    count, refined = m, 0
    _minimise(program, gram, count)
    while True:
        worst = most_violated(x, G, h, lower, upper)
        if worst < 0:
            if refined < _REFINEMENTS and _refine(gram, count):
                refined += 1
                continue
            return count
        if count == n or _is_active(active, count, m + worst):
            return -1
        if worst < k:
            for j in range(n):
                N[count, j] = -G[worst, j]
            c[count] = -h[worst]
        else:
            at = worst - k if worst < k + n else worst - k - n
            for j in range(n):
                N[count, j] = 0.0
            N[count, at] = 1.0 if worst < k + n else -1.0
            c[count] = lower[at] if worst < k + n else -upper[at]
        active[count] = m + worst
        for j in range(n):
            x[j] = target[j]
        if not _append(N, L, x, c, v, count):
            return -1
        count, refined = count + 1, 0
        _minimise(program, gram, count)
        for i in range(m, count):
            if u[i] < 0.0:
                return -1


@kernel
def _append(N, L, target, c, v, i):
    """Row i of L and of v for the normal in row i of N; false if the others nearly span it."""
    square = _inner(N, i, N, i)
    left, right = square, c[i] - _along(N, i, target)
    for j in range(i):
        total = _inner(N, i, N, j)
        for p in range(j):
            total -= L[i, p] * L[j, p]
        total /= L[j, j]
        L[i, j] = total
        left -= total * total
        right -= total * v[j]
    if not left > _APART * square:
        return False
    L[i, i] = np.sqrt(left)
    v[i] = right / L[i, i]
    return True


@kernel
def _minimise(program, gram, count):
    """u = L^-T v and x = target + N^T u."""
    N, x, L, _, v, u, _ = gram
    for i in range(count):
        u[i] = v[i]
    _solve_transposed(L, u, count)
    for j in range(len(program.target)):
        x[j] = program.target[j]
    _add_combination(N, u, count, x)


@kernel
def _refine(gram, count):
    """Solve once more for what the active constraints are off by; false if they are not."""
    N, x, L, c, v, u, _ = gram
    worst = 0.0
    for i in range(count):
        v[i] = c[i] - _along(N, i, x)
        worst = max(worst, abs(v[i]))
    if not worst > _SETTLED:
        return False
    for i in range(count):
        for j in range(i):
            v[i] -= L[i, j] * v[j]
        v[i] /= L[i, i]
    _solve_transposed(L, v, count)
    _add_combination(N, v, count, x)
    for i in range(count):
        u[i] += v[i]
    return True


@kernel
def _solve_transposed(L, u, count):
    for i in range(count - 1, -1, -1):
        u[i] /= L[i, i]
        for j in range(i):
            u[j] -= L[i, j] * u[i]


@kernel
def _add_combination(N, u, count, x):
    for i in range(count):
        for j in range(len(x)):
            x[j] += u[i] * N[i, j]


@kernel
def _is_active(active, count, number):
    for i in range(count):
        if active[i] == number:
            return True
    return False


@kernel
def _inner(A, i, B, j):
    """A[i] . B[j] of full registers, as four sums that do not wait for each other."""
    p, q, r, s = 0.0, 0.0, 0.0, 0.0
    for t in range(0, A.shape[1], 4):
        p += A[i, t] * B[j, t]
        q += A[i, t + 1] * B[j, t + 1]
        r += A[i, t + 2] * B[j, t + 2]
        s += A[i, t + 3] * B[j, t + 3]
    return (p + q) + (r + s)


@kernel
def _along(A, i, x):
    """A[i] . x likewise."""
    p, q, r, s = 0.0, 0.0, 0.0, 0.0
    for t in range(0, A.shape[1], 4):
        p += A[i, t] * x[t]
        q += A[i, t + 1] * x[t + 1]
        r += A[i, t + 2] * x[t + 2]
        s += A[i, t + 3] * x[t + 3]
    return (p + q) + (r + s)


@kernel
def most_violated(x, G, h, lower, upper):
    """Number of the most violated of rows, lower and upper bounds, or -1."""
    n, k = len(lower), len(h)
    worst, least = -1, -_FEASIBLE
    for i in range(k):
        value = h[i]
        for j in range(n):
            value -= G[i, j] * x[j]
        if value < least and value < -_FEASIBLE * (1.0 + abs(h[i])):
            worst, least = i, value
    for i in range(n):
        value = min(x[i] - lower[i], upper[i] - x[i])
        if value < least:
            low = x[i] - lower[i] <= upper[i] - x[i]
            bound = lower[i] if low else upper[i]
            if value < -_FEASIBLE * (1.0 + abs(bound)):
                worst, least = k + i if low else k + n + i, value
    return worst
