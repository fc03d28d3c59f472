"""Velocity ellipsoids {v : v^T A^-1 v <= 1}, A = J J^T, their volumes and intersections."""

from __future__ import annotations

from math import gamma, pi

import numpy as np

from ..arms.chain import Chain
from ..arms.kernels import Kinematics
from ..kernel import kernel


def unit_ball_volume(dimension: int) -> float:
    """pi^(d/2) / Gamma(d/2 + 1)."""
    return pi ** (dimension / 2) / gamma(dimension / 2 + 1)


def ellipsoid_volume(A: np.ndarray) -> np.ndarray:
    """V = V_d sqrt(det A) for (..., d, d)."""
    root = np.sqrt(np.maximum(np.linalg.det(A), 0.0))
    return unit_ball_volume(A.shape[-1]) * root


def coupled_pair_volume(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """Volume of {v : v^T (A^-1 + B^-1) v <= 1}: two arms that move one body, in one unit ball.

    P. Chiacchio et al., Global task space manipulability ellipsoids for multiple-arm systems, IEEE
    Trans. Robotics and Automation 7(5), 1991. det (A^-1 + B^-1)^-1 = det A det B / det (A + B).
    """
    square = np.linalg.det(A) * np.linalg.det(B) / np.linalg.det(A + B)
    return unit_ball_volume(A.shape[-1]) * np.sqrt(np.maximum(square, 0.0))


def sphere_points(count: int) -> np.ndarray:
    """Directions (count, 3) spread evenly by the golden angle."""
    k = np.arange(count) + 0.5
    z, angle = 1.0 - 2.0 * k / count, pi * (1.0 + 5.0**0.5) * k
    radius = np.sqrt(1.0 - z**2)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), z])


def intersection_volume(matrices: np.ndarray, directions: int = 20_000) -> float:
    """V = (1/3) int_S min_i r_i(u)^3 du, r_i(u) = (u^T A_i^-1 u)^(-1/2), of centred ellipsoids.

    Parameters
    ----------
    matrices : ndarray (K, 3, 3)
        A_i.
    directions : int
        Points of the quadrature on the sphere.
    """
    u = sphere_points(directions)
    inverse = np.linalg.inv(matrices)
    largest = np.einsum("ni,kij,nj->kn", u, inverse, u).max(axis=0)
    return float(4.0 * pi / 3.0 * np.mean(largest**-1.5))


def intersection_volume_monte_carlo(
    matrices: np.ndarray, count: int, rng: np.random.Generator
) -> tuple[float, float]:
    """The same from points drawn in the first ellipsoid.

    Returns
    -------
    volume, standard_error : float
    """
    ball = rng.normal(size=(count, 3))
    ball *= (rng.random(count) ** (1 / 3) / np.linalg.norm(ball, axis=1))[:, np.newaxis]
    v = ball @ np.linalg.cholesky(matrices[0]).T
    inside = (np.einsum("ni,kij,nj->kn", v, np.linalg.inv(matrices), v) <= 1.0).all(axis=0)
    volume, share = float(ellipsoid_volume(matrices[0])), float(inside.mean())
    return volume * share, volume * (share * (1 - share) / count) ** 0.5


def gram_matrices(
    chain: Chain, rotation: np.ndarray, q: np.ndarray, lever: np.ndarray, rows: int
) -> np.ndarray:
    """A = J J^T (M, rows, rows) in world axes at the point ``lever`` away from the flange.

    The velocity of the point is v + omega x r, with r given in world axes.

    Parameters
    ----------
    chain : Chain
    rotation : (3, 3)
        Of the base in the world.
    q : (M, n) [rad]
    lever : (M, 3) [m]
    rows : int
        3 for the translational velocity, 6 for the twist.
    """
    found: np.ndarray = _grams(Kinematics(chain).jacobians(q), rotation, lever, rows)
    return found


@kernel
def _grams(local, rotation, lever, rows):
    count, _, n = local.shape
    out = np.empty((count, rows, rows))
    column = np.empty((6, n))
    for m in range(count):
        x, y, z = lever[m]
        for j in range(n):
            for r in range(3):
                v, w = 0.0, 0.0
                for c in range(3):
                    v += rotation[r, c] * local[m, c, j]
                    w += rotation[r, c] * local[m, 3 + c, j]
                column[r, j], column[3 + r, j] = v, w
            a, b, c = column[3, j], column[4, j], column[5, j]
            column[0, j] += b * z - c * y
            column[1, j] += c * x - a * z
            column[2, j] += a * y - b * x
        for r in range(rows):
            for c in range(r + 1):
                total = 0.0
                for j in range(n):
                    total += column[r, j] * column[c, j]
                out[m, r, c] = out[m, c, r] = total
    return out
