"""Joint steps: how a potential moves an arm. One step per call, readable form.

Results stay within the limits (lower, upper), which are infinite unless they are enforced.
"""

from __future__ import annotations

from itertools import product

import numpy as np

from ...errors import InputError
from ..field.potentials import Potential
from ..settings import Update, UpdateRule

#: Of two neighbours whose potentials agree to this share, the first is taken.
TIE = 1e-12
#: Share of U below which a predicted decrease drowns in rounding.
ROUNDING = 1e-12
#: Order of the changes of one joint; staying comes first.
CHANGES = (0.0, -1.0, 1.0)
Limits = tuple[np.ndarray, np.ndarray]


def next_configuration(
    potential: Potential, q: np.ndarray, step: int, update: Update, limits: Limits
) -> np.ndarray:
    """The configuration after one step by the rule of ``update``, (nq,)."""
    rule = {
        UpdateRule.GRADIENT: gradient_step,
        UpdateRule.FIXED_LENGTH: fixed_length_step,
        UpdateRule.NEIGHBOUR_SEARCH: neighbour_step,
    }[update.rule]
    return rule(potential, q, step, update, limits)


def gradient_step(
    potential: Potential, q: np.ndarray, step: int, update: Update, limits: Limits
) -> np.ndarray:
    """q - t g, t = min(eta, delta/|g|), halved until U falls by a share of what g predicts.

    Sufficient decrease: L. Armijo, Minimization of functions having Lipschitz continuous first
    partial derivatives, Pacific J. Math. 16, 1966. Where none is left that rounding could not
    feign, or after the last halving, q stays: at a minimum, or on a crease of U.
    """
    if update.gain is None:
        raise InputError("Update", "gain", None, "a number: the rule gradient takes it")
    g = potential.gradient(q, step)
    length = float(np.linalg.norm(g))
    if length == 0.0:
        return q
    t = min(update.gain, update.max_step / length)
    here = float(potential.value(q, step))
    for _ in range(update.max_halvings + 1):
        trial = np.clip(q - t * g, *limits)
        predicted = g @ (trial - q)
        if -predicted <= ROUNDING * here:
            break
        if potential.value(trial, step) <= here + update.sufficient_decrease * predicted:
            return trial
        t *= 0.5
    return q


def fixed_length_step(
    potential: Potential, q: np.ndarray, step: int, update: Update, limits: Limits
) -> np.ndarray:
    """q - delta g/|g|; around a minimum it chatters with this length."""
    g = potential.gradient(q, step)
    length = np.linalg.norm(g)
    return q if length == 0.0 else np.clip(q - update.max_step / length * g, *limits)


def neighbour_step(
    potential: Potential, q: np.ndarray, step: int, update: Update, limits: Limits
) -> np.ndarray:
    """argmin of U over the 3^nq neighbours q + delta {0, -1, 1}^nq."""
    offsets = update.max_step * np.array(list(product(CHANGES, repeat=len(q))))
    neighbours = np.clip(q + offsets, *limits)
    values = np.asarray(potential.value(neighbours, step))
    best = 0
    for k, value in enumerate(values):
        if value < values[best] * (1.0 - TIE):
            best = k
    return neighbours[best]
