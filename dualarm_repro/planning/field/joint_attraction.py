"""Attraction in the space of the joints, quadratic near the goal and conic beyond a threshold.

U(q) = zeta/2 |e|^2 for |e| <= d, d zeta |e| - zeta d^2/2 beyond, e = q - q_goal; so |F| <= d zeta.
M. W. Spong, S. Hutchinson, M. Vidyasagar, Robot Modeling and Control, ch. 5. With the threshold
applied to every joint on its own the same holds for each e_j, and U is their sum.
"""

from __future__ import annotations

import numpy as np

from ...kernel import kernel
from ...settings import code
from ..settings import Threshold

_NORM = code(Threshold.NORM)


def conic_potential(
    q: np.ndarray, goal: np.ndarray, gain: float, threshold: float, measure: Threshold
) -> float:
    """U(q) for one configuration (nq,) [rad]."""
    error = np.abs(q - goal)
    size = np.array([np.linalg.norm(error)]) if measure is Threshold.NORM else error
    near = np.minimum(size, threshold)
    return float((gain * (near * size - 0.5 * near**2)).sum())


def conic_force(
    q: np.ndarray, goal: np.ndarray, gain: float, threshold: float, measure: Threshold
) -> np.ndarray:
    """F = -dU/dq (nq,) = -zeta e min(1, d/|e|), or of each joint by itself."""
    error = q - goal
    if measure is Threshold.PER_JOINT:
        return -gain * np.clip(error, -threshold, threshold)
    size = np.linalg.norm(error)
    return -gain * error * (1.0 if size <= threshold else threshold / size)


@kernel
def set_conic_force(q, goal, gain, threshold, measure, out):
    """:func:`conic_force` into ``out``; ``measure`` is the code of a :class:`Threshold`."""
    square = 0.0
    for j in range(len(q)):
        out[j] = goal[j] - q[j]
        square += out[j] * out[j]
    size = np.sqrt(square)
    share = 1.0 if size <= threshold else threshold / size
    for j in range(len(q)):
        if measure == _NORM:
            out[j] *= gain * share
        else:
            out[j] = gain * min(max(out[j], -threshold), threshold)
