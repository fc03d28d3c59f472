"""Velocity dampers: how fast a pair may approach at its distance, and the merged joint bounds."""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from ..settings import code
from .settings import Damper

_LINEAR, _SINE_SQUARED, _STEP = code(Damper.LINEAR), code(Damper.SINE_SQUARED), code(Damper.STEP)


@kernel
def approach_bound(law, d, gain, outer, inner):
    """beta(d) [m/s] in -dd/dt <= beta(d), for d within the outer range.

    linear         k (d - d2): d cannot fall below d2, and grows where it is below (Faverjon, 1987)
    sine_squared   v sin^2(pi/2 (d - d2) / (d1 - d2)), 0 below d2, with v = k (d1 - d2)
    step           v between the ranges, -v below d2
    zero_inside    0
    """
    v = gain * (outer - inner)
    if law == _LINEAR:
        return gain * (d - inner)
    if law == _SINE_SQUARED:
        s = np.sin(0.5 * np.pi * min(max((d - inner) / (outer - inner), 0.0), 1.0))
        return v * s * s
    if law == _STEP:
        return v if d >= inner else -v
    return 0.0


@kernel
def joint_bounds(arrays, numbers, q, lower, upper):
    """Speed limits merged with angle limits.

    lower_i = max(-v_i, k (q_i^- + margin - q_i)) and upper_i likewise, both within -v_i ... v_i, so
    that a joint outside its range is driven back and the bounds never cross.
    """
    for i in range(len(q)):
        v = arrays.speed[i]
        lower[i], upper[i] = -v, v
        if not numbers.limits:
            lower[i], upper[i] = -np.inf, np.inf
        elif numbers.angle_limits:
            k, margin = numbers.limit_gain, numbers.limit_margin
            lower[i] = min(max(k * (arrays.lower[i] + margin - q[i]), -v), v)
            upper[i] = min(max(k * (arrays.upper[i] - margin - q[i]), -v), v)
