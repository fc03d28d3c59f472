"""A motion in closed loop and the quantities that judge it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..arguments import Positive, checked
from ..errors import InputError

#: Tip error up to which a path counts as followed [m]; ten times the repeatability of small arms.
FOLLOWED = 1e-3
#: Excess over a limit that is left to rounding [rad], [rad/s].
_ROUNDING = 1e-9


class JointLimits(NamedTuple):
    """Joint ranges [rad] and largest joint speeds [rad/s], each (n,)."""

    lower: np.ndarray
    upper: np.ndarray
    speed: np.ndarray


@dataclass(frozen=True, eq=False)
class Motion:
    """Samples of a run at a fixed rate.

    A run that reached its end is not completed if on its way a joint left its range or exceeded its
    speed, links touched, or a tip left its path: no solver is asked whether it thinks so.

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
    limits : JointLimits
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
    limits: JointLimits
    stopped: str | None = None

    @property
    def finished(self) -> bool:
        """Whether the run reached its end, whatever happened on the way."""
        return self.stopped is None

    @property
    def broken(self) -> tuple[str, ...]:
        """Which bounds the motion broke: of "angle", "speed", "contact" and "path"."""
        found = {
            "angle": self.angle_excess > _ROUNDING,
            "speed": self.speed_excess > _ROUNDING,
            "contact": self.smallest_distance <= 0.0,
            "path": self.largest_error > FOLLOWED,
        }
        return tuple(name for name, beyond in found.items() if beyond)

    @property
    def completed(self) -> bool:
        """Whether the run reached its end and broke no bound."""
        return self.finished and not self.broken

    @property
    def angle_excess(self) -> float:
        """Largest excess of a joint angle over its range, negative inside [rad]."""
        return float(max((self.q - self.limits.upper).max(), (self.limits.lower - self.q).max()))

    @property
    def speed_excess(self) -> float:
        """Largest excess of a joint speed over its limit, negative inside [rad/s]."""
        return float((np.abs(self.x) - self.limits.speed).max(initial=-np.inf))

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
    def rms_acceleration(self) -> float:
        """Root mean square of dx_i / dt by differences [rad/s^2]; high where a motion chatters."""
        changes = np.diff(self.x, axis=0)
        return float(np.sqrt((changes**2).mean())) / self.dt if len(changes) else 0.0

    @property
    def mean_speed(self) -> float:
        """Mean of |x_i| over joints and time [rad/s]."""
        return float(np.abs(self.x).mean()) if len(self.x) else 0.0

    @property
    def energy(self) -> float:
        """Integral of |x|^2 / 2, which the document calls energy [rad^2/s]."""
        return float(0.5 * self.dt * np.sum(self.x**2))

    @checked
    def drift(self, period: Positive) -> np.ndarray:
        """max_i |q_i(k T) - q_i(0)| after each full period (k,) [rad]."""
        steps = period / self.dt
        if not 0.5 < steps < len(self.q):
            expected = f"from one step, {self.dt:g}, to the {len(self.q)} of the motion [s]"
            raise InputError("Motion.drift", "period", period, expected)
        every = round(steps)
        return np.abs(self.q[every::every] - self.q[0]).max(axis=1)
