"""One velocity problem as arrays: min 1/2 |x - target|^2, A x = b, G x <= h, lower <= x <= upper.

What the kernels take and hand on; :class:`.problem.QuadraticProgram` is the checked one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..kernel import kernel

ProgramShapes = dict[str, tuple[int, ...]]


class ProgramParts(NamedTuple):
    """``target``, ``lower``, ``upper`` (n,), ``A`` (m, n), ``b`` (m,), ``G`` (k, n), ``h`` (k,)."""

    target: np.ndarray
    A: np.ndarray
    b: np.ndarray
    G: np.ndarray
    h: np.ndarray
    lower: np.ndarray
    upper: np.ndarray


def shapes(n: int, m: int, k: int) -> ProgramShapes:
    """Shape of each part for n unknowns, m equalities and k inequalities."""
    return dict(
        zip(ProgramParts._fields, ((n,), (m, n), (m,), (k, n), (k,), (n,), (n,)), strict=True)
    )


class ProgramStack(NamedTuple):
    """Many programs: ``parts`` with a leading axis, G and h padded, and ``rows`` (N,) in use."""

    parts: ProgramParts
    rows: np.ndarray


@kernel
def with_task(parts, b):
    """The same program with another right-hand side of the task."""
    target, A, _, G, h, lower, upper = parts
    return ProgramParts(target, A, b, G, h, lower, upper)


@kernel
def program_of(stack, f):
    """Program number ``f`` of a stack."""
    target, A, b, G, h, lower, upper = stack.parts
    k = stack.rows[f]
    return ProgramParts(target[f], A[f], b[f], G[f, :k], h[f, :k], lower[f], upper[f])
