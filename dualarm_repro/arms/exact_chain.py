"""Link transforms in exact arithmetic (sympy): products, equality, the parameters behind them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import sympy as sp


def craig_transform(alpha: sp.Expr, a: sp.Expr, theta: sp.Expr, d: sp.Expr) -> sp.Matrix:
    """Rx(alpha) Tx(a) Rz(theta) Tz(d), the link transform of J. J. Craig (4, 4)."""
    about_x = sp.diag(sp.rot_ccw_axis1(alpha), 1)
    about_z = sp.diag(sp.rot_ccw_axis3(theta), 1)
    about_x[0, 3], about_z[2, 3] = a, d
    return about_x * about_z


def craig_parameters(link: sp.Matrix) -> tuple[float, float, float]:
    """a [m], d [m] and alpha [rad] of a link transform in Craig's form, recovered from it alone.

    The first row gives a, the third column (0, -sin alpha, cos alpha) gives alpha, and d is the
    projection of the translation on that column.
    """
    axis, shift = link[:3, 2], link[:3, 3]
    return float(shift[0]), float(axis.dot(shift)), float(sp.atan2(-axis[1], axis[2]))


def same_function(left: sp.Matrix, right: sp.Matrix) -> bool:
    """Whether two matrices are the same function of their variables."""
    return (left - right).applyfunc(sp.simplify).is_zero_matrix is True


def chain_product(links: Sequence[sp.Matrix]) -> sp.Matrix:
    """Product of link transforms, expanded."""
    total = sp.eye(4)
    for link in links:
        total = (total * link).applyfunc(sp.expand)
    return total


def evaluated(pose: sp.Matrix, variables: Sequence[sp.Symbol], q: np.ndarray) -> np.ndarray:
    """A pose, function of the joint variables (n), at configurations (N, n), (N, 4, 4)."""
    entries = sp.lambdify(list(variables), list(pose), "numpy", cse=True)(*q.T)
    columns = [np.broadcast_to(entry, len(q)) for entry in entries]
    return np.stack(columns, axis=1).reshape(-1, 4, 4)
