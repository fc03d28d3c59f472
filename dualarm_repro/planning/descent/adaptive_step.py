"""Step length that follows the distances of the control points to the obstacles.

alpha = alpha_0 s with s between ``floor`` and ``cap``, sum tau_i = 1:

* saturating: s = sum tau_i min(1, rho_i/rho_0);
* plain_distance: s = sum tau_i rho_i, which depends on the unit of length;
* relative: s = 1 + sum tau_i (rho_i - rho_0)/rho_0, above 1 far from obstacles;
* lengthened: s = 1 + sum tau_i min(1, rho_i/rho_0), never below 1 and 2 far from obstacles.
"""

from __future__ import annotations

from ...kernel import kernel
from ...settings import code
from ..settings import StepRule

_CONSTANT, _SATURATING, _PLAIN, _LENGTHENED = map(
    code,
    (StepRule.CONSTANT, StepRule.SATURATING, StepRule.PLAIN_DISTANCE, StepRule.LENGTHENED),
)


@kernel
def step_length(rule, length, floor, cap, weights, rho, influence):
    """alpha [rad] for distances ``rho`` (K,) [m], infinite without obstacles."""
    if rule == _CONSTANT:
        return length
    share = 1.0 if rule == _LENGTHENED else 0.0
    for k in range(len(rho)):
        if rule == _SATURATING or rule == _LENGTHENED:
            share += weights[k] * min(1.0, rho[k] / influence)
        elif rule == _PLAIN:
            share += weights[k] * rho[k]
        else:
            share += weights[k] * rho[k] / influence
    return length * min(max(share, floor), cap)
