"""E y = e in symbols, for a reader."""

from __future__ import annotations

import sympy as sp

from .....tracking import memo

N, M, H = 3, 2, 4  # unknowns, equalities and inequalities of the symbolic problem


@memo()
def symbols() -> dict[str, sp.Matrix]:
    """phi, lambda, J, dr/dt, C and d of a small problem, and a penalty P left open."""
    return {
        "phi": sp.Matrix(sp.symbols(f"phi_1:{N + 1}", real=True)),
        "multiplier": sp.Matrix(sp.symbols(f"lambda_1:{M + 1}", real=True)),
        "J": sp.Matrix(M, N, sp.symbols(f"J_1:{M * N + 1}", real=True)),
        "rate": sp.Matrix(sp.symbols(f"r_1:{M + 1}", real=True)),
        "C": sp.Matrix(H, N, sp.symbols(f"C_1:{H * N + 1}", real=True)),
        "d": sp.Matrix(sp.symbols(f"d_1:{H + 1}", real=True)),
    }


@memo()
def matrix_equation() -> tuple[sp.Matrix, sp.Matrix, sp.Matrix]:
    """E = [I J^T; J 0], y = [phi; lambda], e = [-C^T P'; dr/dt]."""
    s, P = symbols(), sp.Function("P")
    E = sp.BlockMatrix([[sp.eye(N), s["J"].T], [s["J"], sp.zeros(M, M)]]).as_explicit()
    g = s["C"] * s["phi"] - s["d"]
    slope = sp.Matrix([sp.diff(P(v), s["phi"][0]) / s["C"][i, 0] for i, v in enumerate(g)])
    e = sp.Matrix([*(-s["C"].T * slope), *s["rate"]])
    return E, sp.Matrix([*s["phi"], *s["multiplier"]]), e
