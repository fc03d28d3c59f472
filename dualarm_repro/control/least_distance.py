"""Dual active-set method for min 1/2 |x - target|^2 under equalities, inequalities and bounds.

D. Goldfarb and A. Idnani, A numerically stable dual method for solving strictly convex quadratic
programs, Math. Programming 27, 1983, for the identity as Hessian: the normals of the active
constraints are kept as N = L Q, see :mod:`.active_set`. What few constraints suffice for is left to
:mod:`.few_constraints`. One constraint is a . x >= c;
they are numbered equalities first (A x = b), then rows (-G x >= -h), lower and upper bounds. What
rounding leaves of the active constraints is taken away by a step of iterative refinement.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..kernel import kernel
from .active_set import (
    append_normal,
    dual_direction,
    padded,
    primal_direction,
    remove_normal,
    row_dot,
)
from .few_constraints import Gram, few_constraints, make_gram

SOLVED, INFEASIBLE, ITERATION_LIMIT = 0, 1, 2
_FEASIBLE = 1e-12
_DEPENDENT = 1e-18  # squared sine of a normal against the active span
_MEANT = 1e-8  # violation of a dependent constraint from which on it counts as a contradiction
_SETTLED = 1e-13  # violation of active constraints that is not refined


class Work(NamedTuple):
    """Arrays of the method for n unknowns, reused from problem to problem.

    Attributes
    ----------
    Q, L : (n, N), (n, n)
        See :mod:`.active_set`.
    x, projected, dual : (n,)
    normal, primal : (N,)
        Zero beyond n.
    multiplier : (n + 1,)
    active : (n,) of int
    taken : (m + k + 2 n,) of bool
        Inequalities that are active or give no direction, for the most rows there may be.
    y, z, w : (m,), (k,), (n,)
        Multipliers of the answer.
    gram : Gram
    """

    Q: np.ndarray
    L: np.ndarray
    x: np.ndarray
    normal: np.ndarray
    projected: np.ndarray
    primal: np.ndarray
    dual: np.ndarray
    multiplier: np.ndarray
    active: np.ndarray
    taken: np.ndarray
    y: np.ndarray
    z: np.ndarray
    w: np.ndarray
    gram: Gram


@kernel
def make_work(n, m, k):
    """Arrays for n unknowns, m equalities and at most k rows."""
    width = padded(n)
    return Work(
        np.zeros((n, width)),
        np.empty((n, n)),
        np.empty(n),
        np.zeros(width),
        np.empty(n),
        np.zeros(width),
        np.empty(n),
        np.empty(n + 1),
        np.empty(n, np.int64),
        np.empty(m + k + 2 * n, np.bool_),
        np.empty(m),
        np.empty(k),
        np.empty(n),
        make_gram(n),
    )


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
    work = make_work(len(program.target), len(program.b), len(program.h))
    status = least_distance_within(program, work)
    return status, work.x, work.y, work.z, work.w


@kernel
def least_distance_within(program, work):
    """The same in given arrays, which then hold x and the multipliers; returns the status.

    ``work.z`` may be longer than the program has rows, only its first entries count.
    """
    n, m, k = len(program.target), len(program.b), len(program.h)
    count = few_constraints(program, work.gram)
    if count < 0:
        status, count = by_factors(program, work)
        _hand_over(work, work.active, work.multiplier, count, n, m, k)
        return status
    for j in range(n):
        work.x[j] = work.gram.x[j]
    _hand_over(work, work.gram.active, work.gram.u, count, n, m, k)
    return SOLVED


@kernel
def by_factors(program, work):
    """The dual method for any constraints; returns the status and how many are active."""
    target, _, b, G, h, lower, upper = program
    Q, L, x, a, d, z, r, u, active, taken = work[:10]
    n, m, k = len(target), len(b), len(h)
    for i in range(n):
        x[i] = target[i]
        for j in range(Q.shape[1]):
            Q[i, j] = 0.0
        Q[i, i] = 1.0
    for i in range(m + k + 2 * n):
        taken[i] = False
    count = _take_equalities(program, work)
    if count < 0:
        return INFEASIBLE, 0
    equalities, refined, status = count, False, ITERATION_LIMIT

    for _ in range(20 * (n + k) + 20):
        worst, violation = _most_violated(x, G, h, lower, upper, taken, m)
        if worst < 0:
            if not refined and _refine(program, work, count):
                refined = True
                continue
            status = SOLVED
            break
        refined = False
        first, last, square = _set_normal(worst, G, n, m, k, a)
        u[count] = 0.0
        while True:
            outside = primal_direction(a, first, last, Q, count, d, z)
            dual_direction(L, count, d, r)
            independent = count < n and outside > _DEPENDENT * square
            full = -violation / outside if independent else np.inf
            partial, leaving = np.inf, -1
            for j in range(equalities, count):
                if r[j] > 0.0 and u[j] < partial * r[j]:
                    partial, leaving = u[j] / r[j], j
            t = min(full, partial)
            if t == np.inf:
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
                append_normal(Q, L, count, d, z, outside)
                count += 1
                break
            taken[active[leaving]] = False
            count = remove_normal(Q, L, leaving, count, active, u)
            violation += t * outside if independent else 0.0
        if t == np.inf:
            if _refine(program, work, count):  # it may have been the rounding of many steps
                continue
            if violation < -_MEANT:
                status = INFEASIBLE
                break
            taken[worst] = True  # rounding of constraints that are active
    return status, count


@kernel
def _take_equalities(program, work):
    """Make the equalities active; returns how many are independent, -1 if they contradict."""
    x, a, d, z, count, n = work.x, work.normal, work.projected, work.primal, 0, len(work.x)
    for i in range(len(program.b)):
        first, last, length = n, 0, 0.0
        for j in range(n):
            a[j] = program.A[i, j]
            if a[j] != 0.0:
                first, last = min(first, j), j + 1
                length += a[j] * a[j]
        square = primal_direction(a, first, last, work.Q, count, d, z)
        missing = program.b[i] - row_dot(program.A, i, x, min(first, last), last)
        if count == n or square <= _DEPENDENT * length:
            if abs(missing) > _MEANT:
                return -1
            continue
        t = missing / square
        for j in range(n):
            x[j] += t * z[j]
        work.active[count] = i
        append_normal(work.Q, work.L, count, d, z, square)
        count += 1
    _set_multipliers(program, work, count)
    return count


@kernel
def _set_multipliers(program, work, count):
    """N^T u = x - target for the active normals N."""
    x, a, d, n = work.x, work.normal, work.projected, len(work.x)
    for j in range(n):
        a[j] = x[j] - program.target[j]
    for j in range(count):
        d[j] = row_dot(work.Q, j, a, 0, n)
    dual_direction(work.L, count, d, work.multiplier)


@kernel
def _refine(program, work, count):
    """Solve once more for what the active constraints are off by; returns whether they were."""
    x, d, worst = work.x, work.projected, 0.0
    n, m, k = len(x), len(program.b), len(program.h)
    for j in range(count):
        i = work.active[j]
        if i < m:
            d[j] = program.b[i] - row_dot(program.A, i, x, 0, n)
        elif i < m + k:
            d[j] = row_dot(program.G, i - m, x, 0, n) - program.h[i - m]
        elif i < m + k + n:
            d[j] = program.lower[i - m - k] - x[i - m - k]
        else:
            d[j] = x[i - m - k - n] - program.upper[i - m - k - n]
        worst = max(worst, abs(d[j]))
    if worst <= _SETTLED:
        return False
    for j in range(count):  # L v = d, x += Q_1^T v
        d[j] = (d[j] - row_dot(work.L, j, d, 0, j)) / work.L[j, j]
        for i in range(n):
            x[i] += d[j] * work.Q[j, i]
    _set_multipliers(program, work, count)
    return True


@kernel
def _hand_over(work, active, multiplier, count, n, m, k):
    """Multipliers of the active constraints, with the signs of the answer."""
    y, z, w = work.y, work.z, work.w
    for i in range(m):
        y[i] = 0.0
    for i in range(k):
        z[i] = 0.0
    for i in range(n):
        w[i] = 0.0
    for j in range(count):
        i, u = active[j], multiplier[j]
        if i < m:
            y[i] = -u
        elif i < m + k:
            z[i - m] = u
        elif i < m + k + n:
            w[i - m - k] -= u
        else:
            w[i - m - k - n] += u


@kernel
def _most_violated(x, G, h, lower, upper, taken, m):
    """Number and value of the most violated inequality that is not active, or -1."""
    n, k = len(x), len(h)
    worst, least = -1, 0.0
    for i in range(k):
        value = h[i] - row_dot(G, i, x, 0, n)
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
def _set_normal(i, G, n, m, k, a):
    """Normal of inequality i in the form a . x >= c; returns where it is not zero and |a|^2."""
    square = 0.0
    if i < m + k:
        for j in range(n):
            a[j] = -G[i - m, j]
            square += a[j] * a[j]
        return 0, n, square
    for j in range(n):
        a[j] = 0.0
    at, sign = (i - m - k, 1.0) if i < m + k + n else (i - m - k - n, -1.0)
    a[at] = sign
    return at, at + 1, 1.0
