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

from enum import StrEnum

import numpy as np

from ...kernel import kernel
from ...settings import code


class Activation(StrEnum):
    """The functions."""

    LINEAR = "linear"
    POWER = "power"
    BIPOLAR_SIGMOID = "bipolar_sigmoid"
    POWER_SIGMOID = "power_sigmoid"
    TANH = "tanh"
    SINH = "sinh"
    SIGN_BI_POWER = "sign_bi_power"


_LINEAR, _POWER = code(Activation.LINEAR), code(Activation.POWER)
_BIPOLAR_SIGMOID = code(Activation.BIPOLAR_SIGMOID)
_POWER_SIGMOID = code(Activation.POWER_SIGMOID)
_TANH, _SINH = code(Activation.TANH), code(Activation.SINH)
_SIGMOID, _STEEPNESS, _ROOT = 4.0, 3.0, 0.5
_LARGEST = 50.0  # argument of sinh beyond which it would leave the useful range of floats

#: Psi'(0): power starts flat, sign-bi-power infinitely steep.
SLOPE_AT_ZERO = {
    Activation.LINEAR: 1.0,
    Activation.POWER: 0.0,
    Activation.BIPOLAR_SIGMOID: 0.5 * _SIGMOID / np.tanh(0.5 * _SIGMOID),
    Activation.POWER_SIGMOID: 0.5 * _SIGMOID / np.tanh(0.5 * _SIGMOID),
    Activation.TANH: _STEEPNESS,
    Activation.SINH: _STEEPNESS,
    Activation.SIGN_BI_POWER: np.inf,
}


@kernel
def activation(kind, u):
    """Psi(u) of one entry."""
    if kind == _LINEAR:
        return u
    if kind == _POWER or (kind == _POWER_SIGMOID and abs(u) >= 1.0):
        return u * u * u
    if kind == _BIPOLAR_SIGMOID or kind == _POWER_SIGMOID:
        return np.tanh(0.5 * _SIGMOID * u) / np.tanh(0.5 * _SIGMOID)
    if kind == _TANH:
        return np.tanh(_STEEPNESS * u)
    if kind == _SINH:
        return np.sinh(min(max(_STEEPNESS * u, -_LARGEST), _LARGEST))
    size = abs(u)
    return 0.5 * np.sign(u) * (size**_ROOT + size ** (1.0 / _ROOT))
