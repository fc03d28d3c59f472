"""Variable repulsive gain eta_i = lambda eta_0 against chatter beside an obstacle.

Once the resultant has flipped n times, last at distance rho_s, lambda acts where
|rho - rho_s| <= band:

* power: kappa^n, falling from flip to flip; kappa = 1 is without effect;
* ramp: 1 - kappa (1 - |rho - rho_s|/band);
* proportional: kappa |rho - rho_s|/band.

Elsewhere, and before the first flip, lambda = 1.
"""

from __future__ import annotations

from ...kernel import kernel
from ...settings import code
from ..settings import FlipRule, GainRule

_CONSTANT, _POWER, _RAMP = map(code, (GainRule.CONSTANT, GainRule.POWER, GainRule.RAMP))
_NEGATIVE = code(FlipRule.NEGATIVE)


@kernel
def gain_factor(rule, kappa, band, rho, flip_distance, flips):
    """lambda for one control point at distance ``rho``."""
    away = abs(rho - flip_distance)
    if rule == _CONSTANT or flips == 0 or not away <= band:
        return 1.0
    if rule == _POWER:
        return kappa**flips
    if rule == _RAMP:
        return 1.0 - kappa * (1.0 - away / band)
    return kappa * away / band


@kernel
def is_flip(rule, cosine):
    """Whether two successive resultants with this cosine between them are a flip."""
    return cosine < (0.0 if rule == _NEGATIVE else -0.5)
