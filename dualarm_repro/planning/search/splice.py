"""Smoothing of a joined path: the cubic spline that balances fit against curvature, joint by joint.

f = argmin sum_k w_k (phi_k - f(x_k))^2 + mu int f''(x)^2 dx over the sample number x.
C. H. Reinsch, Smoothing by spline functions, Numerische Mathematik 10, 1967. Weights hold the
ends of the path.
"""

from __future__ import annotations

import numpy as np
import scipy

from ...errors import InputError


def smoothed(path: np.ndarray, smoothing: float, end_weight: float) -> np.ndarray:
    """f at the samples of a path (N, nq), N >= 5.

    Parameters
    ----------
    smoothing : float
        mu >= 0; a larger one gives a smoother path.
    end_weight : float
        w of the first and the last sample, 1 for the others.

    Raises
    ------
    InputError
        Too few samples, or a negative ``smoothing``.
    """
    weights = _weights(path, smoothing, end_weight)
    samples = np.arange(len(path), dtype=float)
    return scipy.interpolate.make_smoothing_spline(samples, path, w=weights, lam=smoothing, axis=0)(
        samples
    )


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
    if len(path) < 5:
        raise InputError("smoothed", "path", f"{len(path)} samples", "at least 5")
    if not smoothing >= 0.0:
        raise InputError("smoothed", "smoothing", smoothing, "a number that is not negative")
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
