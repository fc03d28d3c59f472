"""Rows J_N x <= beta of the mutual avoidance, in five readings of J_N.

With the unit normal n of a pair (a to b), D = J_b - J_a (3, n) of its nearest points and D_a, D_b
the columns of one arm alone, a pair within the outer range gives

pair_normal       -n . D x <= beta              relative approach along the normal: -dd/dt <= beta
arm_normal        -n . D_a x <= beta, same for b        each arm takes the other as standing still
pair_axes         -sgn(n_r) D_r x <= beta, r = x, y, z                   one row per Cartesian axis
arm_axes          the same with D_a and with D_b
pair_components   -n_r D_r x <= n_r^2 beta, r = x, y, z       whose sum is the row of pair_normal
"""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from ..settings import code
from .damper import approach_bound
from .kinematics import relative_velocity
from .settings import PairSelection, RowForm

_PAIR_NORMAL, _ARM_NORMAL = code(RowForm.PAIR_NORMAL), code(RowForm.ARM_NORMAL)
_PAIR_AXES, _ARM_AXES = code(RowForm.PAIR_AXES), code(RowForm.ARM_AXES)
_ALL_WITHIN_OUTER = code(PairSelection.ALL_WITHIN_OUTER)
_SINGLE_NEAREST = code(PairSelection.SINGLE_NEAREST)


@kernel
def select_pairs(arrays, selection, outer, distance, chosen):
    """Numbers of the pairs that give rows, written to ``chosen`` (P,); returns how many."""
    count = 0
    if selection == _ALL_WITHIN_OUTER:
        for k in range(len(distance)):
            if distance[k] < outer:
                chosen[count] = k
                count += 1
        return count
    if selection == _SINGLE_NEAREST:
        nearest = np.argmin(distance)
        chosen[0] = nearest
        return 1 if distance[nearest] < outer else 0
    best = np.full(len(arrays.radius), -1)
    for k in range(len(distance)):
        for side in range(2):
            body = arrays.pairs[k, side]
            if best[body] < 0 or distance[k] < distance[best[body]]:
                best[body] = k
    for k in range(len(distance)):
        i, j = arrays.pairs[k]
        if distance[k] < outer and (best[i] == k or best[j] == k):
            chosen[count] = k
            count += 1
    return count


@kernel
def fill_rows(arrays, numbers, frames, distance, witness, chosen, count, G, h):
    """Write the rows of the chosen pairs; returns how many rows."""
    n = G.shape[1]
    columns = np.empty((2, 3, n))
    row = 0
    for k in chosen[:count]:
        columns[:] = 0.0
        still = np.zeros(2, np.bool_)
        for side in range(2):
            body = arrays.pairs[k, side]
            still[side] = arrays.first[body] == arrays.last[body]
            relative_velocity(
                arrays, frames, body, witness[k, side], 2.0 * side - 1.0, columns[side]
            )
        normal = witness[k, 2]
        beta = approach_bound(
            numbers.damper, distance[k], numbers.damper_gain, numbers.outer, numbers.inner
        )
        form = numbers.form
        if form == _PAIR_NORMAL:
            for j in range(n):
                total = 0.0
                for r in range(3):
                    total -= normal[r] * (columns[0, r, j] + columns[1, r, j])
                G[row, j] = total
            h[row] = beta
            row += 1
        elif form == _ARM_NORMAL:
            for side in range(2):
                if still[side]:  # a fixed base can do nothing about the distance
                    continue
                for j in range(n):
                    total = 0.0
                    for r in range(3):
                        total -= normal[r] * columns[side, r, j]
                    G[row, j] = total
                h[row] = beta
                row += 1
        elif form == _ARM_AXES:
            for side in range(2):
                for r in range(3):
                    if still[side] or normal[r] == 0.0:
                        continue
                    G[row] = -np.sign(normal[r]) * columns[side, r]
                    h[row] = beta
                    row += 1
        else:
            for r in range(3):
                if normal[r] == 0.0:
                    continue
                scale = np.sign(normal[r]) if form == _PAIR_AXES else normal[r]
                G[row] = -scale * (columns[0, r] + columns[1, r])
                h[row] = beta if form == _PAIR_AXES else normal[r] * normal[r] * beta
                row += 1
    return row
