"""Activation functions Psi of neural solvers: odd, increasing, applied entry by entry.

linear           u
power            u^3
bipolar_sigmoid  (1 + e^-4) / (1 - e^-4) (1 - e^-4u) / (1 + e^-4u)
power_sigmoid    bipolar_sigmoid for |u| < 1, u^3 beyond
tanh             tanh(3 u)
sinh             sinh(3 u)
sign_bi_power    (|u|^r + |u|^(1/r)) sgn(u) / 2 with r = 1/2

As listed by Zhang, Li et al. in work on varying-parameter networks. Near the solution only the
slope at zero counts: it multiplies the gain.
"""

from __future__ import annotations

import numpy as np

from ...kernel import kernel

ACTIVATIONS = (
    "linear", "power", "bipolar_sigmoid", "power_sigmoid", "tanh", "sinh", "sign_bi_power",
)  # fmt: skip
LINEAR, POWER, BIPOLAR_SIGMOID, POWER_SIGMOID, TANH, SINH, SIGN_BI_POWER = range(7)
_SIGMOID, _STEEPNESS, _ROOT = 4.0, 3.0, 0.5
_LARGEST = 50.0  # argument of sinh beyond which it would leave the useful range of floats

#: Psi'(0): power starts flat, sign-bi-power infinitely steep.
SLOPE_AT_ZERO = {
    "linear": 1.0,
    "power": 0.0,
    "bipolar_sigmoid": 0.5 * _SIGMOID / np.tanh(0.5 * _SIGMOID),
    "power_sigmoid": 0.5 * _SIGMOID / np.tanh(0.5 * _SIGMOID),
    "tanh": _STEEPNESS,
    "sinh": _STEEPNESS,
    "sign_bi_power": np.inf,
}


@kernel
def activation(kind, u):
    """Psi(u) of one entry."""
    if kind == LINEAR:
        return u
    if kind == POWER or (kind == POWER_SIGMOID and abs(u) >= 1.0):
        return u * u * u
    if kind == BIPOLAR_SIGMOID or kind == POWER_SIGMOID:
        return np.tanh(0.5 * _SIGMOID * u) / np.tanh(0.5 * _SIGMOID)
    if kind == TANH:
        return np.tanh(_STEEPNESS * u)
    if kind == SINH:
        return np.sinh(min(max(_STEEPNESS * u, -_LARGEST), _LARGEST))
    size = abs(u)
    return 0.5 * np.sign(u) * (size**_ROOT + size ** (1.0 / _ROOT))
