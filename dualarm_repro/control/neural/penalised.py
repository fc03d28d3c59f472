"""The penalised problem built anew from its parts, beside the compiled code that solves it."""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize, root

from ...differences import central_differences
from ...settings import code
from ..problem import QuadraticProgram
from ..solvers import solve
from .network_settings import NetworkSettings
from .optimality import optimality, penalised_hessian
from .penalty import penalty


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


def inequalities(p: QuadraticProgram) -> tuple[np.ndarray, np.ndarray]:
    """All inequalities as C x <= d."""
    eye = np.eye(p.size)
    return np.vstack([p.G, eye, -eye]), np.concatenate([p.h, p.upper, -p.lower])


def penalties(p: QuadraticProgram, network: NetworkSettings, x: np.ndarray) -> np.ndarray:
    """P, P' and P'' of all inequalities (h, 3)."""
    C, d = inequalities(p)
    kind = code(network.penalty)
    return np.array([penalty(kind, network.factor, network.sharpness, g) for g in C @ x - d])


def objective(p: QuadraticProgram, network: NetworkSettings, x: np.ndarray) -> float:
    """1/2 |x - target|^2 + sum P."""
    return float(0.5 * np.sum((x - p.target) ** 2) + penalties(p, network, x)[:, 0].sum())


def lagrangian_value(p: QuadraticProgram, network: NetworkSettings, y: np.ndarray) -> float:
    """Objective plus lambda^T (J x - dr/dt), from values of the penalty alone."""
    x = y[: p.size]
    return objective(p, network, x) + float(y[p.size :] @ (p.A @ x - p.b))


def lagrangian_gradient(p: QuadraticProgram, network: NetworkSettings, y: np.ndarray) -> np.ndarray:
    """Derivatives of the Lagrangian by the state, by central differences of its values."""
    return central_differences(lambda state: lagrangian_value(p, network, state), y)


def blocks(
    p: QuadraticProgram, network: NetworkSettings, y: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """E = [I J^T; J 0], y and e = [target - C^T P'; dr/dt]."""
    n, m = p.size, len(p.b)
    E = np.block([[np.eye(n), p.A.T], [p.A, np.zeros((m, m))]])
    push = inequalities(p)[0].T @ penalties(p, network, y[:n])[:, 1]
    return E, y, np.concatenate([p.target - push, p.b])


def minimiser(p: QuadraticProgram, network: NetworkSettings) -> np.ndarray:
    """Minimiser of the penalised objective among the x with A x = b, found without multipliers."""
    basis = np.linalg.svd(p.A)[2][len(p.b) :].T
    start = np.linalg.pinv(p.A) @ p.b
    C = inequalities(p)[0]

    def slope(z: np.ndarray) -> np.ndarray:
        x = start + basis @ z
        return basis.T @ (x - p.target + C.T @ penalties(p, network, x)[:, 1])

    def bend(z: np.ndarray) -> np.ndarray:
        weights = penalties(p, network, start + basis @ z)[:, 2]
        return basis.T @ (np.eye(p.size) + C.T @ (weights[:, None] * C)) @ basis

    found = minimize(
        lambda z: objective(p, network, start + basis @ z),
        np.zeros(basis.shape[1]),
        jac=slope,
        hess=bend,
        method="trust-exact",
        options={"gtol": 1e-10, "maxiter": 500},
    )
    return start + basis @ found.x
