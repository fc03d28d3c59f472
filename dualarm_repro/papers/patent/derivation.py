"""From the penalised problem to E y = e, step by step in symbols and checked in numbers."""

from __future__ import annotations

from functools import partial

import numpy as np
import sympy as sp
from scipy.optimize import root

from ...control.neural.network_settings import NetworkSettings
from ...control.neural.optimality import optimality, penalised_hessian
from ...control.neural.penalty import PENALTIES, penalty
from ...control.problem import Problem
from ...control.recorded import recorded_problems
from ...control.settings import Settings
from ...control.solvers import solve
from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...tracking import memo
from .robots import SEED
from .scenario import COARSE_STEP, frozen, network_of, run

checks = partial(REGISTRY.checks, page="patent/network")
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
def lagrangian() -> sp.Expr:
    """L = 1/2 phi^T phi + sum_i P(c_i phi - d_i) + lambda^T (J phi - dr/dt)."""
    s, P = symbols(), sp.Function("P")
    constraint = s["C"] * s["phi"] - s["d"]
    energy = (s["phi"].T * s["phi"])[0] / 2
    return (
        energy + sum(map(P, constraint)) + (s["multiplier"].T * (s["J"] * s["phi"] - s["rate"]))[0]
    )


@memo()
def gradients() -> sp.Matrix:
    """dL/dphi over dL/dlambda."""
    s = symbols()
    return sp.Matrix([sp.diff(lagrangian(), v) for v in [*s["phi"], *s["multiplier"]]])


@memo()
def matrix_equation() -> tuple[sp.Matrix, sp.Matrix, sp.Matrix]:
    """E = [I J^T; J 0], y = [phi; lambda], e = [-C^T P'; dr/dt]."""
    s, P = symbols(), sp.Function("P")
    E = sp.BlockMatrix([[sp.eye(N), s["J"].T], [s["J"], sp.zeros(M, M)]]).as_explicit()
    g = s["C"] * s["phi"] - s["d"]
    slope = sp.Matrix([sp.diff(P(v), s["phi"][0]) / s["C"][i, 0] for i, v in enumerate(g)])
    e = sp.Matrix([*(-s["C"].T * slope), *s["rate"]])
    return E, sp.Matrix([*s["phi"], *s["multiplier"]]), e


def same(left: sp.Matrix, right: sp.Matrix) -> bool:
    """Whether two matrices are the same expression."""
    return (left - right).applyfunc(lambda v: sp.simplify(v.doit())).is_zero_matrix is True


@checks(
    "patent.eq_lagrangian",
    rules=[
        Is(key="multiplier_enters", value=True, label="dL/dlambda is the equality J phi - dr/dt"),
        Is(
            key="objective_kept",
            value=True,
            label="where the equality holds, L is the penalised objective",
        ),
    ],
)
def lagrange_function(assumed: Assumed) -> Result:
    """The Lagrangian in symbols for any penalty."""
    s = symbols()
    residual = s["J"] * s["phi"] - s["rate"]
    enters = same(gradients()[N:, :], residual)
    solved = sp.solve(list(residual), list(s["rate"]), dict=True)[0]
    kept = not lagrangian().subs(solved).expand().has(*s["multiplier"])
    return Result(
        obtained={"multiplier_enters": enters, "objective_kept": kept},
        caption=(
            "The Lagrangian is fixed by the words around the lost formula: objective with "
            "penalty, plus lambda times the equality. In symbols its derivative by lambda is that "
            "equality, and where the equality holds lambda drops out. Nothing about the penalty "
            "is needed."
        ),
    )


@checks(
    "patent.eq_kkt",
    samples=32,
    rules=[
        Bounded(
            key="residual", high=1e-6, label="both derivatives at the rest point of the network"
        ),
        Bounded(key="better_nearby", high=1e-9, label="a feasible neighbour is better by at most"),
    ],
)
def optimality_conditions(assumed: Assumed) -> Result:
    """The two derivatives vanish where the network rests, and no neighbour is better."""
    network = network_of(assumed, "penalty_form", "penalty_factor", "penalty_sharpness")
    p = sample_problem()
    y = rest_point(p, network)
    F = np.empty(len(y))
    optimality(network.numbers(), *p.parts, y, F)
    best = _penalised_objective(p, network, y[: p.size])
    basis = np.linalg.svd(p.A)[2][len(p.b) :]
    rng = np.random.default_rng(SEED)
    moves = 1e-3 * rng.normal(size=(200, len(basis))) @ basis
    gain = max(best - _penalised_objective(p, network, y[: p.size] + move) for move in moves)
    return Result(
        obtained={"residual": float(np.abs(F).max()), "better_nearby": float(gain)},
        caption=(
            "At the rest point of the network both derivatives are zero to "
            f"{np.abs(F).max():.1e}. Of 200 random neighbours that keep the tip velocity none has "
            "a smaller penalised objective: the objective is convex, so that the conditions are "
            "enough."
        ),
    )


@checks(
    "patent.eq_matrix",
    rules=[
        Is(key="equivalent", value=True, label="E y - e is both derivatives, one above the other")
    ],
)
def matrix_form(assumed: Assumed) -> Result:
    """E y = e in symbols against the gradients of the Lagrangian."""
    E, y, e = matrix_equation()
    return Result(
        obtained={"equivalent": same(E * y - e, gradients())},
        caption=(
            "With E = [I, J^T; J, 0], y = [phi; lambda] and e = [-grad P; dr/dt] the printed "
            "equation E y = e is exactly the pair of derivatives set to zero, in symbols and for "
            "any penalty. Since P depends on phi, e depends on the unknown y: the equation is not "
            "linear."
        ),
    )


@checks(
    "patent.eq_error",
    rules=[
        Is(key="equivalent", value=True, label="xi = E y - e is the gradient of the Lagrangian"),
        Bounded(key="compiled", high=1e-9, label="the code's error differs from E y - e by"),
        Bounded(key="at_minimiser", high=1e-6, label="and at the minimiser it is"),
    ],
)
def error_function(assumed: Assumed) -> Result:
    """xi of the code against E y - e built from its blocks, for every penalty form."""
    E, y, e = matrix_equation()
    p, worst, rest = sample_problem(), 0.0, 0.0
    rng = np.random.default_rng(SEED)
    for name in PENALTIES:
        network = NetworkSettings(penalty=name)
        state, F = 0.1 * rng.normal(size=p.size + len(p.b)), np.empty(p.size + len(p.b))
        optimality(network.numbers(), *p.parts, state, F)
        scale = max(1.0, float(np.abs(F).max()))
        worst = max(worst, float(np.abs(F - _blocks(p, network, state)).max()) / scale)
        optimality(network.numbers(), *p.parts, rest_point(p, network), F)
        rest = max(rest, float(np.abs(F).max()))
    return Result(
        obtained={
            "equivalent": same(E * y - e, gradients()),
            "compiled": worst,
            "at_minimiser": rest,
        },
        caption=(
            f"The error that the code drives to zero is E y - e: in symbols, and to {worst:.1e} "
            f"of its size with the blocks built anew for {len(PENALTIES)} forms of the penalty. "
            f"At the minimiser it is {rest:.1e}."
        ),
    )


@checks(
    "patent.eq_matrix_defs",
    samples=8,
    rules=[
        Bounded(
            key="derivative",
            high=1e-5,
            label="the state matrix is the derivative of the error by y",
        ),
        NoOriginal(key="formula", label="the blocks"),
    ],
)
def matrix_blocks(assumed: Assumed) -> Result:
    """The matrix in front of the state derivative against differences of xi by y."""
    network = network_of(assumed, "state_matrix", "penalty_form")
    p = sample_problem()
    size, n = p.size + len(p.b), p.size
    y, step = rest_point(p, NetworkSettings(penalty=network.penalty)), 1e-7
    M_y, hessian, ends = np.zeros((size, size)), np.empty((n, n)), np.empty((2, size))
    penalised_hessian(network.numbers(), p.target, p.G, p.h, p.lower, p.upper, y, hessian)
    M_y[:n, :n], M_y[:n, n:], M_y[n:, :n] = hessian, p.A.T, p.A
    worst = 0.0
    for k in range(size):
        for end, sign in zip(ends, (1.0, -1.0), strict=True):
            moved = y.copy()
            moved[k] += sign * step
            optimality(network.numbers(), *p.parts, moved, end)
        worst = max(worst, float(np.abs((ends[0] - ends[1]) / (2 * step) - M_y[:, k]).max()))
    size_of = float(np.abs(M_y).max())
    return Result(
        obtained={"derivative": worst / size_of},
        caption=(
            "Differentiating the error by the state gives E with the Hessian of the penalty added "
            f"to its identity block; differences of the error agree to {worst / size_of:.1e} of "
            "the largest entry. Without the Hessian the matrix is E itself, and no longer the "
            "derivative."
        ),
    )


@memo()
def sample_problem() -> Problem:
    """The problem of the frozen task with the largest multiplier of an avoidance row."""
    scenario, settings = frozen("crossing"), Settings()
    motion = run(scenario, settings, COARSE_STEP)
    problems = recorded_problems(scenario.system, scenario.circles, motion, settings, 20)
    return max(problems, key=lambda p: float(solve(p).z.max(initial=0.0)))


def rest_point(p: Problem, network: NetworkSettings) -> np.ndarray:
    """Where the network rests on a problem that stands still."""
    return state_with_error(p, network, np.zeros(p.size + len(p.b)))


def state_with_error(p: Problem, network: NetworkSettings, xi: np.ndarray) -> np.ndarray:
    """The state y at which F(y) = xi."""
    exact = solve(p)
    numbers, parts, n = network.numbers(), p.parts, p.size

    def error(y: np.ndarray) -> np.ndarray:
        F = np.empty(len(y))
        optimality(numbers, *parts, np.ascontiguousarray(y), F)
        return F - xi

    def derivative(y: np.ndarray) -> np.ndarray:
        M_y, hessian = np.zeros((len(y), len(y))), np.empty((n, n))
        penalised_hessian(
            numbers, p.target, p.G, p.h, p.lower, p.upper, np.ascontiguousarray(y), hessian
        )
        M_y[:n, :n], M_y[:n, n:], M_y[n:, :n] = hessian, p.A.T, p.A
        return M_y

    return root(error, np.concatenate([exact.x, exact.y]), jac=derivative, method="lm", tol=1e-14).x


def _stacked(p: Problem) -> tuple[np.ndarray, np.ndarray]:
    """All inequalities as C x <= d."""
    eye = np.eye(p.size)
    return np.vstack([p.G, eye, -eye]), np.concatenate([p.h, p.upper, -p.lower])


def _penalties(p: Problem, network: NetworkSettings, x: np.ndarray) -> np.ndarray:
    """P, P' and P'' of all inequalities (h, 3)."""
    C, d = _stacked(p)
    kind = PENALTIES.index(network.penalty)
    return np.array([penalty(kind, network.factor, network.sharpness, g) for g in C @ x - d])


def _penalised_objective(p: Problem, network: NetworkSettings, x: np.ndarray) -> float:
    return float(0.5 * np.sum((x - p.target) ** 2) + _penalties(p, network, x)[:, 0].sum())


def _blocks(p: Problem, network: NetworkSettings, y: np.ndarray) -> np.ndarray:
    """E y - e from its blocks."""
    n, m = p.size, len(p.b)
    E = np.block([[np.eye(n), p.A.T], [p.A, np.zeros((m, m))]])
    push = _stacked(p)[0].T @ _penalties(p, network, y[:n])[:, 1]
    return E @ y - np.concatenate([p.target - push, p.b])
