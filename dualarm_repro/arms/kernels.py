"""Batch kinematics of a revolute serial chain, vectorised over configurations (numba).

T(q) = C_0 Rz(q_1) C_1 Rz(q_2) ... Rz(q_n) C_n, with constant C_j in which every joint axis is z.
Configurations are taken in blocks of ``LANES``; all intermediate values of a block live in one
flat buffer at constant places, so that the compiler sees no aliasing and turns the inner loops
into SIMD code.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..kernel import kernel
from .trigonometry import FAR, sincos

LANES = 64
# Places in the buffer: sine and cosine of one joint, rotation (row major), translation, Jacobian.
_COS = LANES
_ROT = 2 * LANES
_POS = 11 * LANES
_JAC = 14 * LANES


class Chain(NamedTuple):
    """Constant transforms C_0 ... C_n: ``rotation`` (n+1, 3, 3), ``translation`` (n+1, 3) [m]."""

    rotation: np.ndarray
    translation: np.ndarray


@kernel
def poses(chain, q):
    """T(q) for every row of ``q`` (N, n) [rad] -> (N, 4, 4) [m]."""
    count, n = q.shape
    out = np.empty((count, 4, 4))
    w = np.zeros(_JAC)
    for start in range(0, count, LANES):
        rows = min(LANES, count - start)
        _set_pose(chain, w)
        for j in range(n):
            _load_sincos(q, start, rows, j, w)
            _advance(chain, j + 1, w)
        for k in range(rows):
            for r in range(3):
                for c in range(3):
                    out[start + k, r, c] = w[_ROT + (3 * r + c) * LANES + k]
                out[start + k, r, 3] = w[_POS + r * LANES + k]
                out[start + k, 3, r] = 0.0
            out[start + k, 3, 3] = 1.0
    return out


@kernel
def frame_origins(chain, q):
    """Origins of the joint frames and of the flange, (N, n) [rad] -> (N, n+1, 3) [m]."""
    count, n = q.shape
    out = np.empty((count, n + 1, 3))
    w = np.zeros(_JAC)
    for start in range(0, count, LANES):
        rows = min(LANES, count - start)
        _set_pose(chain, w)
        for j in range(n + 1):
            for k in range(rows):
                for r in range(3):
                    out[start + k, j, r] = w[_POS + r * LANES + k]
            if j < n:
                _load_sincos(q, start, rows, j, w)
                _advance(chain, j + 1, w)
    return out


@kernel
def positions(chain, q):
    """Position C_0 Rz(q_1) ... C_{n-1} Rz(q_n) t_n of the flange, (N, n) [rad] -> (N, 3) [m]."""
    count, n = q.shape
    out = np.empty((count, 3))
    w = np.zeros(5 * LANES)
    for start in range(0, count, LANES):
        rows = min(LANES, count - start)
        for r in range(3):
            for k in range(LANES):
                w[(2 + r) * LANES + k] = chain.translation[n, r]
        for j in range(n - 1, -1, -1):
            _load_sincos(q, start, rows, j, w)
            C, t = chain.rotation[j], chain.translation[j]
            c00, c01, c02, t0 = C[0, 0], C[0, 1], C[0, 2], t[0]
            c10, c11, c12, t1 = C[1, 0], C[1, 1], C[1, 2], t[1]
            c20, c21, c22, t2 = C[2, 0], C[2, 1], C[2, 2], t[2]
            for k in range(LANES):
                s, c = w[k], w[_COS + k]
                a, b, z = w[2 * LANES + k], w[3 * LANES + k], w[4 * LANES + k]
                x = a * c - b * s
                y = a * s + b * c
                w[2 * LANES + k] = c00 * x + c01 * y + c02 * z + t0
                w[3 * LANES + k] = c10 * x + c11 * y + c12 * z + t1
                w[4 * LANES + k] = c20 * x + c21 * y + c22 * z + t2
        for k in range(rows):
            for r in range(3):
                out[start + k, r] = w[(2 + r) * LANES + k]
    return out


@kernel
def jacobians(chain, q):
    """Columns [z_j x (p - o_j); z_j] in base axes at the flange, (N, n) [rad] -> (N, 6, n)."""
    count, n = q.shape
    out = np.empty((count, 6, n))
    w = np.zeros(_JAC + 6 * n * LANES)
    for start in range(0, count, LANES):
        rows = min(LANES, count - start)
        _jacobian_block(chain, q, start, rows, w)
        for k in range(rows):
            for row in range(6):
                for j in range(n):
                    out[start + k, row, j] = w[_JAC + (row * n + j) * LANES + k]
    return out


@kernel
def manipulabilities(chain, q):
    """w = sqrt(det(J J^T)) as the product of the norms of J's orthogonalised rows, -> (N,).

    Gram-Schmidt on the rows keeps full accuracy near singularities, where det(J J^T) would lose
    half of the digits (Yoshikawa 1985 for the measure).
    """
    count, n = q.shape
    out = np.empty(count)
    w = np.zeros(_JAC + 6 * n * LANES)
    for start in range(0, count, LANES):
        rows = min(LANES, count - start)
        _jacobian_block(chain, q, start, rows, w)
        for k in range(LANES):
            w[k] = 1.0
        for i in range(6):
            row = _JAC + i * n * LANES
            _inner(w, row, row, n)
            for k in range(LANES):
                square = w[_COS + k]
                w[k] *= np.sqrt(square)
                w[_ROT + k] = 1.0 / square if square > 0.0 else 0.0
            for other in range(i + 1, 6):
                below = _JAC + other * n * LANES
                _inner(w, row, below, n)
                for j in range(n):
                    for k in range(LANES):
                        part = w[_COS + k] * w[_ROT + k]
                        w[below + j * LANES + k] -= part * w[row + j * LANES + k]
        for k in range(rows):
            out[start + k] = w[k]
    return out


@kernel
def _load_sincos(q, start, rows, joint, w):
    """Sine and cosine of one joint for a block; lanes past the end keep what they held."""
    far = False
    for k in range(rows):
        x = q[start + k, joint]
        far |= abs(x) > FAR
        w[k] = x
    if far:  # many turns of a joint that turns for ever
        for k in range(LANES):
            x = w[k]
            s, c = sincos(x) if abs(x) <= FAR else (math.sin(x), math.cos(x))
            w[k] = s
            w[_COS + k] = c
        return
    for k in range(LANES):
        s, c = sincos(w[k])
        w[k] = s
        w[_COS + k] = c


@kernel
def _set_pose(chain, w):
    for r in range(3):
        for k in range(LANES):
            w[_POS + r * LANES + k] = chain.translation[0, r]
        for c in range(3):
            for k in range(LANES):
                w[_ROT + (3 * r + c) * LANES + k] = chain.rotation[0, r, c]


@kernel
def _advance(chain, j, w):
    """Pose of the block times Rz(q_j) C_j."""
    C, t = chain.rotation[j], chain.translation[j]
    c00, c01, c02, t0 = C[0, 0], C[0, 1], C[0, 2], t[0]
    c10, c11, c12, t1 = C[1, 0], C[1, 1], C[1, 2], t[1]
    c20, c21, c22, t2 = C[2, 0], C[2, 1], C[2, 2], t[2]
    for r in range(3):
        for k in range(LANES):
            s, c = w[k], w[_COS + k]
            a = w[_ROT + 3 * r * LANES + k]
            b = w[_ROT + (3 * r + 1) * LANES + k]
            z = w[_ROT + (3 * r + 2) * LANES + k]
            x = a * c + b * s
            y = b * c - a * s
            w[_ROT + 3 * r * LANES + k] = x * c00 + y * c10 + z * c20
            w[_ROT + (3 * r + 1) * LANES + k] = x * c01 + y * c11 + z * c21
            w[_ROT + (3 * r + 2) * LANES + k] = x * c02 + y * c12 + z * c22
            w[_POS + r * LANES + k] += x * t0 + y * t1 + z * t2


@kernel
def _jacobian_block(chain, q, start, rows, w):
    """Geometric Jacobian of a block, entry (row, joint) at _JAC + (row n + joint) LANES."""
    n = q.shape[1]
    _set_pose(chain, w)
    for j in range(n):
        for r in range(3):
            for k in range(LANES):
                w[_JAC + (r * n + j) * LANES + k] = w[_POS + r * LANES + k]
                w[_JAC + ((3 + r) * n + j) * LANES + k] = w[_ROT + (3 * r + 2) * LANES + k]
        _load_sincos(q, start, rows, j, w)
        _advance(chain, j + 1, w)
    step = n * LANES
    for j in range(n):
        first = _JAC + j * LANES
        for k in range(LANES):
            i = first + k
            x = w[_POS + k] - w[i]
            y = w[_POS + LANES + k] - w[i + step]
            z = w[_POS + 2 * LANES + k] - w[i + 2 * step]
            a, b, c = w[i + 3 * step], w[i + 4 * step], w[i + 5 * step]
            w[i] = b * z - c * y
            w[i + step] = c * x - a * z
            w[i + 2 * step] = a * y - b * x


@kernel
def _inner(w, row, other, n):
    """Inner products of two rows of the Jacobian, left in the place of the cosine."""
    for k in range(LANES):
        w[_COS + k] = 0.0
    for j in range(n):
        for k in range(LANES):
            w[_COS + k] += w[row + j * LANES + k] * w[other + j * LANES + k]
