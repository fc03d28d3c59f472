"""Exact and iterative solvers for one stated problem; every answer is certified."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import daqp
import numpy as np
import proxsuite
import qpsolvers
from qpsolvers import available_solvers

from ..arguments import checked
from ..errors import UnknownNameError
from .least_distance import INFEASIBLE, SOLVED, least_distance
from .problem import CERTIFIED, NoSolution, QuadraticProgram, Solution
from .statement import solve_statement

_UNBOUNDED = 1e30  # a bound beyond this is none, for every back end


def _active_set(problem: QuadraticProgram) -> Solution:
    status, *parts = least_distance(problem.parts)
    if status == SOLVED and (found := Solution(problem, *parts)).certified():
        return found
    if (other := second_opinion(problem)) is not None:
        return other
    if status != SOLVED:
        reason = "the constraints exclude each other" if status == INFEASIBLE else "iteration limit"
        raise NoSolution("active_set", problem, reason)
    return Solution(problem, *parts)


def _daqp(problem: QuadraticProgram) -> Solution:
    p, n, m = problem, problem.size, len(problem.b)
    rows = np.ascontiguousarray(np.vstack([p.A, p.G]))
    upper = np.concatenate([p.upper.clip(max=_UNBOUNDED), p.b, p.h])
    lower = np.concatenate([p.lower.clip(min=-_UNBOUNDED), p.b, np.full(len(p.h), -_UNBOUNDED)])
    sense = np.zeros(len(upper), dtype=np.int32)
    sense[n : n + m] = 5  # active and immutable: an equality
    x, _, flag, info = daqp.solve(np.eye(n), -p.target, rows, upper, lower, sense)
    if flag < 1:
        raise NoSolution("daqp", problem, f"exit flag {flag}")
    multipliers = np.array(info["lam"])
    return Solution(
        problem, np.array(x), multipliers[n : n + m], multipliers[n + m :], multipliers[:n]
    )


def second_opinion(problem: QuadraticProgram) -> Solution | None:
    """What DAQP finds where the own method finds nothing it can certify; None without certificate.

    Its answers to badly conditioned problems are other ones, and either may be the one that holds.
    """
    try:
        found = _daqp(problem)
    except NoSolution:
        return None
    return found if found.certified() else None


def _proxqp(problem: QuadraticProgram) -> Solution:
    p, n, m, k = problem, problem.size, len(problem.b), len(problem.h)
    qp = proxsuite.proxqp.dense.QP(n, m, k, True)
    qp.settings.eps_abs, qp.settings.eps_rel = 1e-9, 0.0
    qp.settings.eps_primal_inf = 1e-12  # the default 1e-4 calls feasible problems infeasible
    lower, upper = p.lower.clip(min=-_UNBOUNDED), p.upper.clip(max=_UNBOUNDED)
    qp.init(np.eye(n), -p.target, p.A, p.b, p.G, np.full(k, -_UNBOUNDED), p.h, lower, upper)
    qp.solve()
    if qp.results.info.status != proxsuite.proxqp.QPSolverOutput.PROXQP_SOLVED:
        raise NoSolution("proxqp", problem, str(qp.results.info.status))
    z = qp.results.z
    return Solution(problem, qp.results.x, qp.results.y, z[:k], z[k:])


def _through_qpsolvers(name: str, **settings: Any) -> Callable[[QuadraticProgram], Solution]:
    def solve(problem: QuadraticProgram) -> Solution:
        p = problem
        stated = qpsolvers.Problem(
            *(np.eye(p.size), -p.target, p.G if len(p.h) else None, p.h if len(p.h) else None),
            *(p.A if len(p.b) else None, p.b if len(p.b) else None),
            *(p.lower.clip(min=-_UNBOUNDED), p.upper.clip(max=_UNBOUNDED)),
        )
        try:
            found = qpsolvers.solve_problem(stated, solver=name, **settings)
        except (qpsolvers.QPError, ValueError, ArithmeticError) as error:
            raise NoSolution(name, problem, str(error)) from None
        if not found.found or found.x is None:
            raise NoSolution(name, problem, "none found")
        y, z = (np.zeros(0) if part is None else part for part in (found.y, found.z))
        w = np.zeros(p.size) if found.z_box is None else found.z_box
        return Solution(problem, found.x, y, z, w)

    return solve


_Entry = tuple[Callable[[QuadraticProgram], Solution], float]
#: Solver name to the function and the largest residual its answers may have. These come with the
#: package; what is judged asks no others.
SOLVERS: dict[str, _Entry] = {
    "active_set": (_active_set, CERTIFIED),
    "daqp": (_daqp, CERTIFIED),
    "proxqp": (_proxqp, 1e-6),
    "piqp": (_through_qpsolvers("piqp", eps_abs=1e-9, eps_rel=0.0), 1e-6),
    "cvxpy": (solve_statement, 1e-6),
}
#: Solvers of the extra `solvers`, whose licences ask more than that of the package.
OPTIONAL_SOLVERS: dict[str, _Entry] = {
    "quadprog": (_through_qpsolvers("quadprog"), CERTIFIED),
}


@checked
def solve(problem: QuadraticProgram, solver: str = "active_set") -> Solution:
    """Solve and certify a problem.

    Raises
    ------
    UnknownNameError
        No such solver, or one of an extra that is not installed.
    NoSolution
        Infeasible, or the answer fails its certificate.
    """
    known = SOLVERS | {n: s for n, s in OPTIONAL_SOLVERS.items() if n in available_solvers}
    if solver not in known:
        more = [f"{name} (extra `solvers`)" for name in OPTIONAL_SOLVERS if name not in known]
        expected = f"one of {', '.join([*known, *more])}"
        raise UnknownNameError("solve", "solver", solver, expected)
    function, tolerance = known[solver]
    solution = function(problem)
    if not solution.certified(tolerance):
        raise NoSolution(solver, problem, f"the answer has the residual {solution.residual:.1e}")
    return solution
