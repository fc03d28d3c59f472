"""A motion in closed loop and the quantities that judge it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Motion:
    """Samples of a run at a fixed rate.

    Attributes
    ----------
    dt : float
        Step [s].
    time : (N + 1,) [s]
    q : (N + 1, n) [rad]
    x : (N, n)
        Joint velocity over each step [rad/s].
    error : (N + 1, A)
        Distance of each tip from its path [m].
    distance : (N + 1,)
        Smallest surface distance of the watched pairs [m].
    rows : (N,)
        Rows of the avoidance.
    slack : (N,)
        What the task gave up [m/s].
    stopped : str or None
        Why the run ended before its time.
    """

    dt: float
    time: np.ndarray
    q: np.ndarray
    x: np.ndarray
    error: np.ndarray
    distance: np.ndarray
    rows: np.ndarray
    slack: np.ndarray
    stopped: str | None = None

    @property
    def completed(self) -> bool:
        """Whether the run reached its end."""
        return self.stopped is None

    @property
    def smallest_distance(self) -> float:
        """min over time [m]."""
        return float(self.distance.min())

    @property
    def largest_error(self) -> float:
        """max over time and arms [m]."""
        return float(self.error.max())

    @property
    def peak_speed(self) -> float:
        """max |x_i| [rad/s]."""
        return float(np.abs(self.x).max(initial=0.0))

    @property
    def peak_acceleration(self) -> float:
        """max |dx_i / dt| by differences [rad/s^2]."""
        return float(np.abs(np.diff(self.x, axis=0)).max(initial=0.0) / self.dt)

    @property
    def energy(self) -> float:
        """Integral of |x|^2 / 2, which the document calls energy [rad^2/s]."""
        return float(0.5 * self.dt * np.sum(self.x**2))

    def drift(self, period: float) -> np.ndarray:
        """max_i |q_i(k T) - q_i(0)| after each full period (k,) [rad]."""
        every = round(period / self.dt)
        return np.abs(self.q[every::every] - self.q[0]).max(axis=1)
