"""Penalty functions P(g) that stand in for g <= 0, with first and second derivative.

quadratic          p/2 max(0, g)^2
softplus           (p/s) ln(1 + e^(s g)), which tends to the exact penalty p max(0, g)
squared_softplus   p/2 (ln(1 + e^(s g)) / s)^2, which tends to the quadratic one and is smooth
exponential        p e^(s g)

p is the factor and s the sharpness. The multiplier of a constraint is P'(g) at the minimiser, so
that softplus needs p above the largest multiplier, and the others miss by about P'^-1(multiplier).
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from ...kernel import kernel
from ...settings import code


class Penalty(StrEnum):
    """The forms."""

    QUADRATIC = "quadratic"
    SOFTPLUS = "softplus"
    SQUARED_SOFTPLUS = "squared_softplus"
    EXPONENTIAL = "exponential"


_QUADRATIC = code(Penalty.QUADRATIC)
_SOFTPLUS = code(Penalty.SOFTPLUS)
_EXPONENTIAL = code(Penalty.EXPONENTIAL)
_STEEPEST = 60.0  # exponent at which the exponential goes on as a parabola, lest it overflow


@kernel
def penalty(kind, p, s, g):
    """P(g), P'(g), P''(g) of one inequality.

    Beyond s g = 60 the exponential continues as its second-order expansion, so that a far state has
    a finite penalty and the problem stays convex.
    """
    if kind == _QUADRATIC:
        if g > 0.0:
            return 0.5 * p * g * g, p * g, p
        return 0.0, 0.0, 0.0
    if kind == _EXPONENTIAL:
        far = max(s * g - _STEEPEST, 0.0)
        value = p * np.exp(min(s * g, _STEEPEST))
        return value * (1.0 + far + 0.5 * far * far), value * s * (1.0 + far), value * s * s
    t = s * g
    decay = np.exp(-abs(t))
    soft = (max(t, 0.0) + np.log1p(decay)) / s
    share = (1.0 if t >= 0.0 else decay) / (1.0 + decay)
    bend = s * decay / ((1.0 + decay) * (1.0 + decay))
    if kind == _SOFTPLUS:
        return p * soft, p * share, p * bend
    return 0.5 * p * soft * soft, p * soft * share, p * (share * share + soft * bend)
