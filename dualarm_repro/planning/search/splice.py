"""Smoothing of a joined path: the cubic spline that balances fit against curvature, joint by joint.

f = argmin sum_k w_k (phi_k - f(x_k))^2 + mu int f''(x)^2 dx over the sample number x.
C. H. Reinsch, Smoothing by spline functions, Numerische Mathematik 10, 1967. Weights hold the
ends of the path.
"""

from __future__ import annotations

import numpy as np

from ...errors import InputError
from ...kernel import kernel


def smoothed(path: np.ndarray, smoothing: float, end_weight: float) -> np.ndarray:
    """f at the samples of a path (N, nq), N >= 5.

    f = phi - mu W^-1 Q g with (R + mu Q^T W^-1 Q) g = Q^T phi, a system of five diagonals.

    Parameters
    ----------
    smoothing : float
        mu >= 0; a larger one gives a smoother path.
    end_weight : float
        w > 0 of the first and the last sample, 1 for the others.

    Raises
    ------
    InputError
        Too few samples or NaN among them, a negative ``smoothing``, an ``end_weight`` that is not
        positive, or numbers so large that the curve is not finite.
    """
    weights = _weights(path, smoothing, end_weight)
    found = np.array(path, dtype=float, order="C")
    if not np.isfinite(found).all():
        raise InputError("smoothed", "path", path, "finite numbers")
    _smooth(found, weights, float(smoothing))
    if not np.isfinite(found).all():
        raise InputError("smoothed", "smoothing", smoothing, "a number whose curve is finite")
    return found


@kernel
def _smooth(path, weights, smoothing):
    """:func:`smoothed` in place, by L D L^T of the system."""
    inner, joints = len(path) - 2, path.shape[1]
    pivot, first, second = np.empty(inner), np.zeros(inner), np.zeros(inner)
    g = np.empty((inner, joints))
    for k in range(inner):
        a, b, c = 1.0 / weights[k], 1.0 / weights[k + 1], 1.0 / weights[k + 2]
        diagonal = 4.0 / 6.0 + smoothing * (a + 4.0 * b + c)
        beside = 1.0 / 6.0 - 2.0 * smoothing * (b + c)
        beyond = smoothing * c
        if k >= 1:
            diagonal -= first[k - 1] ** 2 * pivot[k - 1]
            beside -= first[k - 1] * second[k - 1] * pivot[k - 1]
        if k >= 2:
            diagonal -= second[k - 2] ** 2 * pivot[k - 2]
        pivot[k] = diagonal
        if k + 1 < inner:
            first[k] = beside / diagonal
        if k + 2 < inner:
            second[k] = beyond / diagonal
        for j in range(joints):
            g[k, j] = path[k, j] - 2.0 * path[k + 1, j] + path[k + 2, j]
            if k >= 1:
                g[k, j] -= first[k - 1] * g[k - 1, j]
            if k >= 2:
                g[k, j] -= second[k - 2] * g[k - 2, j]
    for k in range(inner - 1, -1, -1):
        for j in range(joints):
            g[k, j] /= pivot[k]
            if k + 1 < inner:
                g[k, j] -= first[k] * g[k + 1, j]
            if k + 2 < inner:
                g[k, j] -= second[k] * g[k + 2, j]
    for k in range(inner):
        for j in range(joints):
            path[k, j] -= smoothing / weights[k] * g[k, j]
            path[k + 1, j] += 2.0 * smoothing / weights[k + 1] * g[k, j]
            path[k + 2, j] -= smoothing / weights[k + 2] * g[k, j]


def smoothed_directly(path: np.ndarray, smoothing: float, end_weight: float) -> np.ndarray:
    """The same from the normal equations (W + mu K) f = W phi, K = Q R^-1 Q^T of a natural
    spline.
    """
    weights = np.diag(_weights(path, smoothing, end_weight))
    return np.linalg.solve(weights + smoothing * _curvature(len(path)), weights @ path)


def roughness(path: np.ndarray) -> float:
    """int f''(x)^2 dx of the natural cubic spline through the samples, summed over the joints."""
    return float(np.einsum("kj,km,mj->", path, _curvature(len(path)), path))


def _weights(path: np.ndarray, smoothing: float, end_weight: float) -> np.ndarray:
    if np.ndim(path) != 2:
        raise InputError("smoothed", "path", np.shape(path), "samples (N, nq)")
    if len(path) < 5:
        raise InputError("smoothed", "path", f"{len(path)} samples", "at least 5")
    if not 0.0 <= smoothing < np.inf:
        raise InputError("smoothed", "smoothing", smoothing, "a number that is not negative")
    if not 0.0 < end_weight < np.inf:
        raise InputError("smoothed", "end_weight", end_weight, "a positive number")
    weights = np.ones(len(path))
    weights[[0, -1]] = end_weight
    return weights


def _curvature(count: int) -> np.ndarray:
    """K with int f''^2 = f^T K f for values f at 0 ... count - 1 (Reinsch 1967)."""
    inner = count - 2
    Q = np.zeros((count, inner))
    for k in range(inner):
        Q[k : k + 3, k] = 1.0, -2.0, 1.0
    R = (4.0 * np.eye(inner) + np.eye(inner, k=1) + np.eye(inner, k=-1)) / 6.0
    return Q @ np.linalg.solve(R, Q.T)
