"""The penalised problem built anew from its parts, beside the compiled code that solves it."""

from __future__ import annotations

import numpy as np
from scipy.optimize import root

from ...control.neural.network_settings import NetworkSettings
from ...control.neural.optimality import optimality, penalised_hessian
from ...control.neural.penalty import penalty
from ...control.problem import QuadraticProgram
from ...control.recorded import recorded_problems
from ...control.settings import ControllerSettings
from ...control.solvers import solve
from ...settings import code
from ...tracking import memo
from .constants import COARSE_STEP
from .scenario import frozen, run


@memo()
def sample_problem() -> QuadraticProgram:
    """The problem of the frozen task with the largest multiplier of an avoidance row."""
    scenario, settings = frozen("crossing"), ControllerSettings()
    motion = run(scenario, settings, COARSE_STEP)
    problems = recorded_problems(scenario.system, scenario.circles, motion, settings, 20)
    return max(problems, key=lambda p: float(solve(p).z.max(initial=0.0)))


def rest_point(p: QuadraticProgram, network: NetworkSettings) -> np.ndarray:
    """Where the network rests on a problem that stands still."""
    return state_with_error(p, network, np.zeros(p.size + len(p.b)))


def state_with_error(p: QuadraticProgram, network: NetworkSettings, xi: np.ndarray) -> np.ndarray:
    """The state y at which F(y) = xi."""
    exact = solve(p)

    def derivative(y: np.ndarray) -> np.ndarray:
        return state_matrix(p, network, y)

    def error(y: np.ndarray) -> np.ndarray:
        return code_error(p, network, y) - xi

    return root(error, np.concatenate([exact.x, exact.y]), jac=derivative, method="lm", tol=1e-14).x


def code_error(p: QuadraticProgram, network: NetworkSettings, y: np.ndarray) -> np.ndarray:
    """F(y) of the compiled code."""
    F = np.empty(len(y))
    optimality(network.numbers(), p.parts, np.ascontiguousarray(y), F)
    return F


def state_matrix(p: QuadraticProgram, network: NetworkSettings, y: np.ndarray) -> np.ndarray:
    """The matrix in front of the state derivative, of the compiled code."""
    n = p.size
    M, hessian = np.zeros((len(y), len(y))), np.empty((n, n))
    state = np.ascontiguousarray(y)
    penalised_hessian(network.numbers(), p.parts, state, hessian)
    M[:n, :n], M[:n, n:], M[n:, :n] = hessian, p.A.T, p.A
    return M


def stacked(p: QuadraticProgram) -> tuple[np.ndarray, np.ndarray]:
    """All inequalities as C x <= d."""
    eye = np.eye(p.size)
    return np.vstack([p.G, eye, -eye]), np.concatenate([p.h, p.upper, -p.lower])


def penalties(p: QuadraticProgram, network: NetworkSettings, x: np.ndarray) -> np.ndarray:
    """P, P' and P'' of all inequalities (h, 3)."""
    C, d = stacked(p)
    kind = code(network.penalty)
    return np.array([penalty(kind, network.factor, network.sharpness, g) for g in C @ x - d])


def objective(p: QuadraticProgram, network: NetworkSettings, x: np.ndarray) -> float:
    """1/2 |x - target|^2 + sum P."""
    return float(0.5 * np.sum((x - p.target) ** 2) + penalties(p, network, x)[:, 0].sum())


def lagrangian_value(p: QuadraticProgram, network: NetworkSettings, y: np.ndarray) -> float:
    """Objective plus lambda^T (J x - dr/dt), from values of the penalty alone."""
    x = y[: p.size]
    return objective(p, network, x) + float(y[p.size :] @ (p.A @ x - p.b))


def lagrangian_gradient(
    p: QuadraticProgram, network: NetworkSettings, y: np.ndarray, step: float = 1e-6
) -> np.ndarray:
    """Derivatives of the Lagrangian by the state, by central differences of its values."""
    moves = step * np.eye(len(y))
    return np.array(
        [
            (lagrangian_value(p, network, y + m) - lagrangian_value(p, network, y - m)) / (2 * step)
            for m in moves
        ]
    )


def blocks(
    p: QuadraticProgram, network: NetworkSettings, y: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """E = [I J^T; J 0], y and e = [target - C^T P'; dr/dt]."""
    n, m = p.size, len(p.b)
    E = np.block([[np.eye(n), p.A.T], [p.A, np.zeros((m, m))]])
    push = stacked(p)[0].T @ penalties(p, network, y[:n])[:, 1]
    return E, y, np.concatenate([p.target - push, p.b])
