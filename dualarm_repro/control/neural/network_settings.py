"""Settings of the neural solver."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple

import numpy as np

from ...errors import InputError, UnknownNameError
from .activation import ACTIVATIONS, SLOPE_AT_ZERO
from .penalty import PENALTIES

#: Which time derivatives of the matrix equation the solver is given.
FEED_FORWARDS = ("all", "without_barrier_rate", "none")


class NetworkNumbers(NamedTuple):
    """As the kernels read them; ``cap`` limits the gain [1/s], infinite for none."""

    penalty: int
    factor: float
    sharpness: float
    activation: int
    gamma: float
    growing: bool
    hessian: bool
    feed_forward: int
    cap: float


@dataclass(frozen=True, kw_only=True)
class NetworkSettings:
    """M dy/dt = -dF/dt - gain Psi(F), gain = gamma e^t or gamma.

    Attributes
    ----------
    penalty : str
        Of :data:`.penalty.PENALTIES`.
    factor, sharpness : float
        p and s of the penalty.
    activation : str
        Of :data:`.activation.ACTIVATIONS`.
    gamma : float
        [1/s]
    growing : bool
        gamma e^t (varying-parameter network), else gamma (zeroing network of fixed parameter).
    hessian : bool
        Whether M holds the Hessian of the penalty; without it M is the E of E y = e.
    feed_forward : str
        Of :data:`FEED_FORWARDS`.
    capped : bool
        Whether a solver of fixed step limits the gain to 1 / (step Psi'(0)).

    Raises
    ------
    InputError
        A gain or parameter that is not positive and finite.
    UnknownNameError
        A name that is not in its list.
    """

    penalty: str = "squared_softplus"
    factor: float = 1e4
    sharpness: float = 1e3
    activation: str = "linear"
    gamma: float = 10.0
    growing: bool = True
    hessian: bool = True
    feed_forward: str = "all"
    capped: bool = True

    def __post_init__(self) -> None:
        for name in ("factor", "sharpness", "gamma"):
            value = getattr(self, name)
            if not (isinstance(value, int | float) and isfinite(value) and value > 0):
                raise InputError("NetworkSettings", name, value, "a positive finite number")
        for name, known in (
            ("penalty", PENALTIES),
            ("activation", ACTIVATIONS),
            ("feed_forward", FEED_FORWARDS),
        ):
            if getattr(self, name) not in known:
                expected = f"one of {', '.join(known)}"
                raise UnknownNameError("NetworkSettings", name, getattr(self, name), expected)

    def numbers(self, dt: float | None = None) -> NetworkNumbers:
        """For the kernels; ``dt`` is the step of a solver of fixed step."""
        slope = SLOPE_AT_ZERO[self.activation]
        # Flat or vertical at zero there is no such limit; 1 / step is the linear one.
        slope = slope if 0.0 < slope < np.inf else 1.0
        cap = 1.0 / (dt * slope) if dt is not None and self.capped else np.inf
        return NetworkNumbers(
            PENALTIES.index(self.penalty),
            float(self.factor),
            float(self.sharpness),
            ACTIVATIONS.index(self.activation),
            float(self.gamma),
            bool(self.growing),
            bool(self.hessian),
            FEED_FORWARDS.index(self.feed_forward),
            float(cap),
        )
