"""Joint steps of :mod:`.updates`, compiled."""

from __future__ import annotations

import numpy as np

from ...arms.chain import Chain
from ...copies import copy_row, copy_rows
from ...kernel import kernel
from ...scene.posing import set_frames
from ...settings import code
from ..field.field_kernels import attractions, evaluate, flange, gradient, repulsion, total_of
from ..settings import UpdateRule
from .updates import CHANGES, ROUNDING, TIE

_GRADIENT = code(UpdateRule.GRADIENT)
_NEIGHBOUR_SEARCH = code(UpdateRule.NEIGHBOUR_SEARCH)


@kernel
def move(field, rules, q, step, attracts, here, work, out):
    """One joint step from ``q``, where U = ``here``, into ``out``; see :mod:`.updates`.

    ``attracts`` tells whether the goal and whether the virtual point attract.
    """
    if rules.update == _NEIGHBOUR_SEARCH:
        _neighbour_step(field, rules, q, step, attracts, work, out)
        return
    gradient(field, q, step, attracts, work)
    slope = work.gradient
    length = np.sqrt((slope * slope).sum())
    if length == 0.0:
        copy_row(q, out)
    elif rules.update == _GRADIENT:
        _gradient_step(field, rules, q, step, attracts, here, length, work, out)
    else:
        _shift(rules, q, rules.max_step / length, slope, out)


@kernel
def _shift(rules, q, t, slope, out):
    """q - t slope within the limits, into ``out``; returns the change of U it predicts."""
    predicted = 0.0
    for j in range(len(q)):
        out[j] = min(max(q[j] - t * slope[j], rules.lower[j]), rules.upper[j])
        predicted += slope[j] * (out[j] - q[j])
    return predicted


@kernel
def _gradient_step(field, rules, q, step, attracts, here, length, work, out):
    t = min(rules.gain, rules.max_step / length)
    for _ in range(rules.max_halvings + 1):
        predicted = _shift(rules, q, t, work.gradient, out)
        if -predicted <= ROUNDING * here:
            break
        terms = evaluate(field, out, step, work)
        if total_of(terms, attracts) <= here + rules.sufficient_decrease * predicted:
            return
        t *= 0.5
    copy_row(q, out)


@kernel
def _neighbour_step(field, rules, q, step, attracts, work, out):
    """Search of the tree whose level j holds the choices for joint j.

    Every term is positive, so a branch whose terms so far exceed the best total is left.
    """
    n = len(q)
    frames = work.frames
    copy_rows(field.base, frames[0])
    partial, joint_square, virtual_square = np.zeros(n + 1), np.zeros(n + 1), np.zeros(n + 1)
    partial[0] = repulsion(field, 0, field.first[1], step, work)
    choice, trial = np.zeros(n, dtype=np.int64), q.copy()
    best = np.inf
    j = 0
    while j >= 0:
        if choice[j] == len(CHANGES):
            choice[j] = 0
            j -= 1
            continue
        angle = q[j] + rules.max_step * CHANGES[choice[j]]
        choice[j] += 1
        trial[j] = min(max(angle, rules.lower[j]), rules.upper[j])
        joint = Chain(field.chain.rotation[j : j + 1], field.chain.translation[j : j + 1])
        set_frames(joint, frames[j], trial[j : j + 1], frames[j : j + 2])
        partial[j + 1] = partial[j]
        if field.first[j + 2] > field.first[j + 1]:
            partial[j + 1] += repulsion(field, field.first[j + 1], field.first[j + 2], step, work)
        joint_square[j + 1] = joint_square[j] + (trial[j] - field.goal[j]) ** 2
        virtual_square[j + 1] = virtual_square[j] + (trial[j] - field.virtual_joints[j]) ** 2
        bound = partial[j + 1]
        if attracts[0]:
            bound += 0.5 * field.joint_gain * joint_square[j + 1]
        if bound >= best * (1.0 - TIE):
            continue
        if j < n - 1:
            j += 1
            continue
        X = flange(field, frames[n])
        attractive, virtual = attractions(field, X, joint_square[n], virtual_square[n])
        total = partial[n]
        if attracts[0]:
            total += attractive
        if attracts[1]:
            total += virtual
        if total < best * (1.0 - TIE):
            best = total
            copy_row(trial, out)
