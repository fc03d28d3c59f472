"""The printed matrices (1)-(7) as sympy matrices, read from the ledger and from nowhere else."""

from __future__ import annotations

import numpy as np
import sympy as sp

from .....arms.exact_chain import craig_parameters, same_function
from .....ledger import REGISTRY
from .....tracking import memo
from ...document import LENGTHS, robot

A, ALPHA, D, THETA = sp.symbols("a_prev alpha_prev d theta", real=True)
LINKS = range(1, 7)
#: Lengths that the matrices share with the published robot.
SHARED = ("a1", "a3", "d4", "d6")
_NAMES = {"a_prev": A, "alpha_prev": ALPHA, "d_i": D, "theta_i": THETA}


def joint_variable(k: int) -> sp.Symbol:
    """Joint variable of joint k, as the arms name it."""
    return sp.Symbol(f"q_{k}", real=True)


@memo()
def link_matrix(k: int) -> sp.Matrix:
    """Printed transform from link k-1 to link k, matrices (2)-(7), lengths as exact fractions."""
    printed = REGISTRY.printed(f"xue.eq{k + 1:02d}")["matrix"]
    names = {f"theta_{k}": joint_variable(k)}
    return sp.Matrix(
        [[sp.sympify(cell, locals=names, rational=True) for cell in row] for row in printed]
    )


@memo()
def general_matrix(corrected: bool) -> sp.Matrix:
    """Printed transform (1): as it stands, or with alpha in place of a inside sine and cosine."""
    printed = REGISTRY.printed("xue.eq01")["matrix"]
    cells = [[cell.replace("a_{i-1}", "a_prev") for cell in row] for row in printed]
    matrix = sp.Matrix([[sp.sympify(cell, locals=_NAMES) for cell in row] for row in cells])
    if not corrected:
        return matrix
    return matrix.replace(
        lambda part: isinstance(part, sp.sin | sp.cos) and part.args[0] == A,
        lambda part: part.func(ALPHA),
    )


def substituted(k: int, *, corrected: bool, mirrored: bool = False) -> sp.Matrix:
    """Transform (1) with the parameters of link k put in, or with alpha and theta negated."""
    joint, sign = robot("matrices").joints[k - 1], -1 if mirrored else 1
    twist = sp.Rational(joint.alpha.coefficient) * (sp.pi if joint.alpha.of_pi else 1)
    values = {
        A: sp.Rational(repr(joint.a)),
        ALPHA: sign * twist,
        D: sp.Rational(repr(joint.d)),
        THETA: sign * joint_variable(k),
    }
    return general_matrix(corrected).subs(values)


def matrices_given(*, corrected: bool) -> list[int]:
    """Numbers of the matrices that (1) gives, as it stands or with the twist angle in it."""
    equal = (same_function(substituted(k, corrected=corrected), link_matrix(k)) for k in LINKS)
    return [k + 1 for k, same in zip(LINKS, equal, strict=True) if same]


def printed_parameters() -> dict[str, list[float]]:
    """a_{i-1}, d_i and alpha_{i-1} recovered from matrices (2)-(7) alone."""
    columns = zip(*(craig_parameters(link_matrix(k)) for k in LINKS), strict=True)
    return dict(zip(("a", "d", "alpha"), map(list, columns), strict=True))


def printed_lengths() -> dict[str, float]:
    """Link lengths and offsets of matrices (2)-(7), under the names of the published ones."""
    found = printed_parameters()
    return {name: found[column][row] for name, (column, row) in LENGTHS.items()}


def table_parameters() -> dict[str, list[float]]:
    """Columns a_{i-1}, d_i and alpha_{i-1} of Table 1 under their printed headers."""
    printed = REGISTRY.printed("xue.tab01")
    return {
        name: [float(sp.sympify(cell)) for cell in printed[name]] for name in ("a", "d", "alpha")
    }


def table_pose(q: np.ndarray) -> np.ndarray:
    """Pose of the flange (4, 4) by Table 1, read under its own headers, at angles (6,)."""
    rows, pose = table_parameters(), np.eye(4)
    link = sp.lambdify([A, ALPHA, D, THETA], general_matrix(corrected=True), "numpy")
    for values in zip(rows["a"], rows["alpha"], rows["d"], q, strict=True):
        pose = pose @ np.asarray(link(*values), dtype=float)
    return pose
