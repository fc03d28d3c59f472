"""Dual active-set method for min 1/2 |x - target|^2 under equalities, inequalities and bounds.

D. Goldfarb and A. Idnani, A numerically stable dual method for solving strictly convex quadratic
programs, Math. Programming 27, 1983, for the identity as Hessian: the normals of the active
constraints are kept as N = Q R. One constraint is a . x >= c; they are numbered equalities first
(A x = b), then rows (-G x >= -h), lower and upper bounds.
"""

from __future__ import annotations

import numpy as np

from ..copies import copy_row
from ..kernel import kernel

SOLVED, INFEASIBLE, ITERATION_LIMIT = 0, 1, 2
_FEASIBLE = 1e-12
_DEPENDENT = 1e-18  # squared sine of a normal against the active span
_MEANT = 1e-8  # violation from which on a dependent constraint contradicts the active ones


@kernel
def least_distance(program):
    """Solve one program.

    Parameters
    ----------
    program : ProgramParts
        Of contiguous float arrays.

    Returns
    -------
    status : int
        ``SOLVED``, ``INFEASIBLE`` or ``ITERATION_LIMIT``.
    x : (n,)
    y, z, w : (m,), (k,), (n,)
        Multipliers as in :class:`.problem.Solution`.
    """
    target, A, b, G, h, lower, upper = program
    n, m, k = len(target), len(b), len(h)
    x, a = target.copy(), np.empty(n)
    Q, R = np.eye(n), np.zeros((n, n))
    d, r, z, u = np.empty(n), np.empty(n), np.empty(n), np.zeros(n + 1)
    active = np.empty(n, np.int64)
    taken = np.zeros(m + k + 2 * n, np.bool_)
    count, equalities, status = 0, 0, SOLVED

    for i in range(m):
        copy_row(A[i], a)
        square = _directions(a, Q, R, count, d, r, z)
        missing = b[i] - _dot(a, x)
        if square <= _DEPENDENT * _dot(a, a):
            if abs(missing) > _MEANT:
                status = INFEASIBLE
                break
            continue
        t = missing / square
        for j in range(n):
            x[j] += t * z[j]
        for j in range(count):
            u[j] -= t * r[j]
        u[count] = t
        active[count] = i
        _append(Q, R, count, d)
        count += 1
    equalities = count

    for _ in range(20 * (n + k)):
        if status != SOLVED:
            break
        worst, violation = _most_violated(x, G, h, lower, upper, taken, m)
        if worst < 0:
            break
        _normal(worst, G, n, m, k, a)
        u[count] = 0.0
        while True:
            square = _directions(a, Q, R, count, d, r, z)
            independent = count < n and square > _DEPENDENT * _dot(a, a)
            full = -violation / square if independent else np.inf
            partial, leaving = np.inf, -1
            for j in range(equalities, count):
                if r[j] > 0.0 and u[j] < partial * r[j]:
                    partial, leaving = u[j] / r[j], j
            t = min(full, partial)
            if t == np.inf:
                if violation < -_MEANT:
                    status = INFEASIBLE
                taken[worst] = True  # else it is the rounding of constraints that are active
                break
            for j in range(count):
                u[j] -= t * r[j]
            u[count] += t
            if independent:
                for j in range(n):
                    x[j] += t * z[j]
            if t == full:
                active[count] = worst
                taken[worst] = True
                _append(Q, R, count, d)
                count += 1
                break
            taken[active[leaving]] = False
            count = _remove(Q, R, leaving, count, active, u)
            violation += t * square if independent else 0.0
    else:
        status = ITERATION_LIMIT

    y_out, z_out, w_out = np.zeros(m), np.zeros(k), np.zeros(n)
    for j in range(count):
        i = active[j]
        if i < m:
            y_out[i] = -u[j]
        elif i < m + k:
            z_out[i - m] = u[j]
        elif i < m + k + n:
            w_out[i - m - k] -= u[j]
        else:
            w_out[i - m - k - n] += u[j]
    return status, x, y_out, z_out, w_out


@kernel
def _dot(a, b):
    total = 0.0
    for j in range(len(a)):
        total += a[j] * b[j]
    return total


@kernel
def _directions(a, Q, R, count, d, r, z):
    """d = Q^T a, primal direction z = Q_2 d_2, dual direction r = R^-1 d_1; returns a . z."""
    n = len(a)
    d[:] = 0.0
    for i in range(n):
        if a[i] != 0.0:
            for j in range(n):
                d[j] += Q[i, j] * a[i]
    square = 0.0
    for j in range(count, n):
        square += d[j] * d[j]
    for i in range(n):
        total = 0.0
        for j in range(count, n):
            total += Q[i, j] * d[j]
        z[i] = total
    for i in range(count - 1, -1, -1):
        total = d[i]
        for j in range(i + 1, count):
            total -= R[i, j] * r[j]
        r[i] = total / R[i, i]
    return square


@kernel
def _rotate(Q, j, c, s):
    """Turn the columns j-1 and j of Q."""
    for i in range(len(Q)):
        p, q = Q[i, j - 1], Q[i, j]
        Q[i, j - 1], Q[i, j] = c * p + s * q, c * q - s * p


@kernel
def _append(Q, R, count, d):
    """Add the normal with coordinates d as last column of R."""
    for j in range(len(d) - 1, count, -1):
        if d[j] != 0.0:
            length = np.hypot(d[j - 1], d[j])
            c, s = d[j - 1] / length, d[j] / length
            d[j - 1], d[j] = length, 0.0
            _rotate(Q, j, c, s)
    for i in range(count + 1):
        R[i, count] = d[i]


@kernel
def _remove(Q, R, leaving, count, active, u):
    """Drop one active constraint and make R triangular again; returns the new count."""
    for j in range(leaving, count - 1):
        active[j] = active[j + 1]
        u[j] = u[j + 1]
        for i in range(j + 2):
            R[i, j] = R[i, j + 1]
    u[count - 1] = u[count]
    for j in range(leaving + 1, count):
        length = np.hypot(R[j - 1, j - 1], R[j, j - 1])
        c, s = R[j - 1, j - 1] / length, R[j, j - 1] / length
        for column in range(j - 1, count - 1):
            p, q = R[j - 1, column], R[j, column]
            R[j - 1, column], R[j, column] = c * p + s * q, c * q - s * p
        _rotate(Q, j, c, s)
    return count - 1


@kernel
def _most_violated(x, G, h, lower, upper, taken, m):
    """Number and value of the most violated inequality that is not active, or -1."""
    n, k = len(x), len(h)
    worst, least = -1, 0.0
    for i in range(k):
        value = h[i] - _dot(G[i], x)
        if value < least and value < -_FEASIBLE * (1.0 + abs(h[i])) and not taken[m + i]:
            worst, least = m + i, value
    for i in range(n):
        value = x[i] - lower[i]
        if value < least and value < -_FEASIBLE * (1.0 + abs(lower[i])) and not taken[m + k + i]:
            worst, least = m + k + i, value
        value = upper[i] - x[i]
        if (
            value < least
            and value < -_FEASIBLE * (1.0 + abs(upper[i]))
            and not taken[m + k + n + i]
        ):
            worst, least = m + k + n + i, value
    return worst, least


@kernel
def _normal(i, G, n, m, k, a):
    """Normal of inequality i in the form a . x >= c."""
    a[:] = 0.0
    if i < m + k:
        for j in range(n):
            a[j] = -G[i - m, j]
    elif i < m + k + n:
        a[i - m - k] = 1.0
    else:
        a[i - m - k - n] = -1.0
