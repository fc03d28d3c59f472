"""The problem as a mathematician writes it: a disciplined parametrised program in cvxpy."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from .parts import shapes
from .problem import NoSolution, QuadraticProgram, Solution

_IN_PLACE_OF_INFINITY = 1e6  # [rad/s] stands for an absent bound: a parameter has to be finite


@lru_cache(maxsize=8)
def statement(n: int, m: int, k: int) -> tuple[Any, dict[str, Any], Any, list[Any]]:
    """min 1/2 |x - target|^2  s.t.  A x = b, G x <= h, lower <= x <= upper, with named parameters.

    Returns
    -------
    problem, parameters, x, constraints
        The cvxpy problem for n unknowns, m equalities and k inequalities, compiled once.
    """
    import cvxpy as cp

    x = cp.Variable(n)
    p = {name: cp.Parameter(shape) for name, shape in shapes(n, m, k).items() if 0 not in shape}
    constraints = [p["lower"] <= x, x <= p["upper"]]
    if m:
        constraints.append(p["A"] @ x == p["b"])
    if k:
        constraints.append(p["G"] @ x <= p["h"])
    objective = cp.Minimize(0.5 * cp.sum_squares(x - p["target"]))
    return cp.Problem(objective, constraints), p, x, constraints


def solve_statement(problem: QuadraticProgram) -> Solution:
    """Solve through cvxpy with Clarabel, the readable reference."""
    import cvxpy as cp

    m, k = len(problem.b), len(problem.h)
    stated, parameters, x, (low, high, *rest) = statement(problem.size, m, k)
    for name, parameter in parameters.items():
        parameter.value = getattr(problem, name).clip(-_IN_PLACE_OF_INFINITY, _IN_PLACE_OF_INFINITY)
    tolerance = {f"tol_{name}": 1e-11 for name in ("gap_abs", "gap_rel", "feas")}
    try:
        stated.solve(solver=cp.CLARABEL, **tolerance)
    except cp.SolverError as error:
        raise NoSolution("cvxpy", problem, str(error)) from None
    if stated.status not in (cp.OPTIMAL, cp.OPTIMAL_INACCURATE):
        raise NoSolution("cvxpy", problem, stated.status)
    y = rest.pop(0).dual_value if m else np.zeros(0)
    z = rest.pop(0).dual_value if k else np.zeros(0)
    # What stands for an absent bound has no multiplier; the certificate judges what is left.
    above = np.where(np.isfinite(problem.upper), high.dual_value, 0.0)
    below = np.where(np.isfinite(problem.lower), low.dual_value, 0.0)
    return Solution(problem, x.value, y, z, above - below)
