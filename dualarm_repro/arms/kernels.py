"""Batch kinematics of a revolute serial chain, vectorised over configurations (numba).

T(q) = C_0 Rz(q_1) C_1 Rz(q_2) ... Rz(q_n) C_n, with constant C_j in which every joint axis is z.
Configurations are taken in blocks of ``LANES``; all intermediate values of a block live in one flat
buffer, so that the compiler need not fear aliasing and turns the inner loops into SIMD code.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from .sincos import sincos

LANES = 64
_POSE = 12 * LANES  # rotation (row major), then translation, then sine and cosine


class Chain(NamedTuple):
    """Constant transforms C_0 ... C_n: ``rotation`` (n+1, 3, 3), ``translation`` (n+1, 3) [m]."""

    rotation: np.ndarray
    translation: np.ndarray


@njit(cache=True)
def _load_sincos(q, start, joint, w, at):
    """Sine and cosine of one joint for a block; the lanes past the end repeat the last row."""
    last = q.shape[0] - 1
    for k in range(LANES):
        w[at + k] = q[min(start + k, last), joint]
    for k in range(LANES):
        w[at + k], w[at + LANES + k] = sincos(w[at + k])


@njit(cache=True)
def _set_pose(chain, w):
    for r in range(3):
        for k in range(LANES):
            w[(9 + r) * LANES + k] = chain.translation[0, r]
            for c in range(3):
                w[(3 * r + c) * LANES + k] = chain.rotation[0, r, c]


@njit(cache=True)
def _advance(chain, j, w):
    """Pose of the block times Rz(q_j) C_j."""
    C, t = chain.rotation[j], chain.translation[j]
    c00, c01, c02, t0 = C[0, 0], C[0, 1], C[0, 2], t[0]
    c10, c11, c12, t1 = C[1, 0], C[1, 1], C[1, 2], t[1]
    c20, c21, c22, t2 = C[2, 0], C[2, 1], C[2, 2], t[2]
    for r in range(3):
        x_at, y_at, z_at, p_at = 3 * r * LANES, (3 * r + 1) * LANES, (3 * r + 2) * LANES, (9 + r) * LANES
        for k in range(LANES):
            s, c = w[_POSE + k], w[_POSE + LANES + k]
            a, b, z = w[x_at + k], w[y_at + k], w[z_at + k]
            x = a * c + b * s
            y = b * c - a * s
            w[x_at + k] = x * c00 + y * c10 + z * c20
            w[y_at + k] = x * c01 + y * c11 + z * c21
            w[z_at + k] = x * c02 + y * c12 + z * c22
            w[p_at + k] += x * t0 + y * t1 + z * t2


@njit(cache=True)
def poses(chain, q):
    """T(q) for every row of ``q`` (N, n) [rad] -> (N, 4, 4) [m]."""
    count, n = q.shape
    out = np.zeros((count, 4, 4))
    w = np.empty(14 * LANES)
    for start in range(0, count, LANES):
        _set_pose(chain, w)
        for j in range(n):
            _load_sincos(q, start, j, w, _POSE)
            _advance(chain, j + 1, w)
        for k in range(min(LANES, count - start)):
            for r in range(3):
                for c in range(3):
                    out[start + k, r, c] = w[(3 * r + c) * LANES + k]
                out[start + k, r, 3] = w[(9 + r) * LANES + k]
            out[start + k, 3, 3] = 1.0
    return out


@njit(cache=True)
def frame_origins(chain, q):
    """Origins of the joint frames and of the flange, (N, n) [rad] -> (N, n+1, 3) [m]."""
    count, n = q.shape
    out = np.empty((count, n + 1, 3))
    w = np.empty(14 * LANES)
    for start in range(0, count, LANES):
        _set_pose(chain, w)
        rows = min(LANES, count - start)
        for j in range(n + 1):
            for k in range(rows):
                for r in range(3):
                    out[start + k, j, r] = w[(9 + r) * LANES + k]
            if j < n:
                _load_sincos(q, start, j, w, _POSE)
                _advance(chain, j + 1, w)
    return out


@njit(cache=True)
def positions(chain, q):
    """Flange position p(q) = C_0 Rz(q_1) ... Rz(q_n) t_n from the flange inwards, -> (N, 3) [m]."""
    count, n = q.shape
    out = np.empty((count, 3))
    w = np.empty(5 * LANES)
    for start in range(0, count, LANES):
        for k in range(LANES):
            for r in range(3):
                w[r * LANES + k] = chain.translation[n, r]
        for j in range(n - 1, -1, -1):
            _load_sincos(q, start, j, w, 3 * LANES)
            C, t = chain.rotation[j], chain.translation[j]
            c00, c01, c02, t0 = C[0, 0], C[0, 1], C[0, 2], t[0]
            c10, c11, c12, t1 = C[1, 0], C[1, 1], C[1, 2], t[1]
            c20, c21, c22, t2 = C[2, 0], C[2, 1], C[2, 2], t[2]
            for k in range(LANES):
                s, c = w[3 * LANES + k], w[4 * LANES + k]
                a, b, z = w[k], w[LANES + k], w[2 * LANES + k]
                x = a * c - b * s
                y = a * s + b * c
                w[k] = c00 * x + c01 * y + c02 * z + t0
                w[LANES + k] = c10 * x + c11 * y + c12 * z + t1
                w[2 * LANES + k] = c20 * x + c21 * y + c22 * z + t2
        for k in range(min(LANES, count - start)):
            for r in range(3):
                out[start + k, r] = w[r * LANES + k]
    return out


@njit(cache=True)
def _jacobian_block(chain, q, start, w, at):
    """Geometric Jacobian of a block into ``w[at:]``, entry (row, joint) at (row n + joint) LANES."""
    n = q.shape[1]
    _set_pose(chain, w)
    for j in range(n):
        for r in range(3):
            linear, angular = at + (r * n + j) * LANES, at + ((3 + r) * n + j) * LANES
            for k in range(LANES):
                w[linear + k] = w[(9 + r) * LANES + k]
                w[angular + k] = w[(3 * r + 2) * LANES + k]
        _load_sincos(q, start, j, w, _POSE)
        _advance(chain, j + 1, w)
    step = n * LANES
    for j in range(n):
        first = at + j * LANES
        for k in range(LANES):
            i = first + k
            x, y, z = w[9 * LANES + k] - w[i], w[10 * LANES + k] - w[i + step], w[11 * LANES + k] - w[i + 2 * step]
            a, b, c = w[i + 3 * step], w[i + 4 * step], w[i + 5 * step]
            w[i] = b * z - c * y
            w[i + step] = c * x - a * z
            w[i + 2 * step] = a * y - b * x


@njit(cache=True)
def jacobians(chain, q):
    """Columns [z_j x (p - o_j); z_j] in base axes at the flange, (N, n) [rad] -> (N, 6, n)."""
    count, n = q.shape
    out = np.empty((count, 6, n))
    at = 14 * LANES
    w = np.empty(at + 6 * n * LANES)
    for start in range(0, count, LANES):
        _jacobian_block(chain, q, start, w, at)
        for k in range(min(LANES, count - start)):
            for row in range(6):
                for j in range(n):
                    out[start + k, row, j] = w[at + (row * n + j) * LANES + k]
    return out


@njit(cache=True)
def manipulabilities(chain, q):
    """w = sqrt(det(J J^T)) as the product of the norms of J's orthogonalised rows, -> (N,).

    Gram-Schmidt on the rows keeps full accuracy near singularities, where det(J J^T) would lose half
    of the digits (Yoshikawa 1985 for the measure).
    """
    count, n = q.shape
    out = np.empty(count)
    at = 14 * LANES
    w = np.empty(at + 6 * n * LANES)
    for start in range(0, count, LANES):
        _jacobian_block(chain, q, start, w, at)
        for k in range(LANES):
            w[k] = 1.0
        for i in range(6):
            row = at + i * n * LANES
            for k in range(LANES):
                w[LANES + k] = 0.0
            for j in range(n):
                for k in range(LANES):
                    w[LANES + k] += w[row + j * LANES + k] ** 2
            for k in range(LANES):
                square = w[LANES + k]
                w[k] *= np.sqrt(square)
                w[LANES + k] = 1.0 / square if square > 0.0 else 0.0
            for other in range(i + 1, 6):
                below = at + other * n * LANES
                for k in range(LANES):
                    w[2 * LANES + k] = 0.0
                for j in range(n):
                    for k in range(LANES):
                        w[2 * LANES + k] += w[row + j * LANES + k] * w[below + j * LANES + k]
                for k in range(LANES):
                    w[2 * LANES + k] *= w[LANES + k]
                for j in range(n):
                    for k in range(LANES):
                        w[below + j * LANES + k] -= w[2 * LANES + k] * w[row + j * LANES + k]
        for k in range(min(LANES, count - start)):
            out[start + k] = w[k]
    return out
