"""Settings of the neural solver."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

import numpy as np
from pydantic import Field

from ...arguments import checked
from ...settings import Positive, Settings, numbers
from .activation import SLOPE_AT_ZERO, Activation
from .penalty import Penalty


class FeedForward(StrEnum):
    """Which time derivatives of the matrix equation the solver is given."""

    ALL = "all"
    WITHOUT_BARRIER_RATE = "without_barrier_rate"
    NONE = "none"


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
    integral: float
    cap: float


class NetworkSettings(Settings):
    """M dy/dt = -dF/dt - gain Psi(F) - kappa int F dt, gain = gamma e^t or gamma.

    The integral is that of noise-tolerant networks (Jin, Zhang, Li and Zhang 2016); the solvers of
    fixed step have it.

    Raises
    ------
    InputError
        A gain or parameter that is not positive and finite.
    UnknownNameError
        A choice that does not exist.
    """

    penalty: Penalty = Penalty.SQUARED_SOFTPLUS
    factor: Positive = Field(default=1e4, description="p of the penalty")
    sharpness: Positive = Field(default=1e3, description="s of the penalty")
    activation: Activation = Activation.LINEAR
    gamma: Positive = Field(default=10.0, description="[1/s]")
    growing: bool = Field(
        default=True,
        description="gamma e^t (varying-parameter network), else gamma (zeroing network)",
    )
    integral: float = Field(
        default=0.0,
        ge=0.0,
        description="kappa of d xi/dt = -gain Psi(xi) - kappa int xi dt, tolerant of noise [1/s^2]",
    )
    hessian: bool = Field(
        default=True,
        description="M holds the Hessian of the penalty; without it M is the E of E y = e",
    )
    feed_forward: FeedForward = FeedForward.ALL
    capped: bool = Field(
        default=True, description="a solver of fixed step limits the gain to 1 / (step Psi'(0))"
    )

    @checked
    def numbers(self, dt: Positive | None = None) -> NetworkNumbers:
        """For the kernels; ``dt`` is the step of a solver of fixed step."""
        slope = SLOPE_AT_ZERO[self.activation]
        # Flat or vertical at zero there is no such limit; 1 / step is the linear one.
        slope = slope if 0.0 < slope < np.inf else 1.0
        cap = 1.0 / (dt * slope) if dt is not None and self.capped else np.inf
        return numbers(NetworkNumbers, self, cap=cap)
