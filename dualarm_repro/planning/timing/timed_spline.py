"""q(s(t)): a cubic spline run through with constant s'' between the points of a grid.

On a piece of the grid x = s'^2 is linear in s and u = s'' its half slope, so that

    qdd = q''(s) x + q'(s) u    is quadratic in s, and    qd = q'(s) sqrt(x)

has its extrema at the ends of the piece and where qdd = 0. The largest speeds and accelerations of
the whole motion are therefore known exactly, not only at the points of the grid.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy


@dataclass(frozen=True, eq=False)
class TimedSpline:
    """A motion along a spline.

    Attributes
    ----------
    spline : scipy.interpolate.CubicSpline
        s -> q (nq,) [rad].
    grid : ndarray (G,)
        Increasing s, all knots of the spline among them.
    square : ndarray (G,)
        x = s'^2 at the grid; of two neighbours one is positive.
    """

    spline: scipy.interpolate.CubicSpline
    grid: np.ndarray
    square: np.ndarray

    @cached_property
    def time(self) -> np.ndarray:
        """When each point of the grid is passed (G,) [s]."""
        rate = np.sqrt(self.square)
        return np.concatenate([[0.0], np.cumsum(2.0 * self._width / (rate[:-1] + rate[1:]))])

    @property
    def _width(self) -> np.ndarray:
        return np.diff(self.grid)

    @property
    def _drive(self) -> np.ndarray:
        """u = s'' on each piece (G-1,)."""
        return 0.5 * np.diff(self.square) / self._width

    def at(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Joints [rad], their speeds and accelerations at times (T,), each (T, nq)."""
        piece = np.clip(np.searchsorted(self.time, time, "right") - 1, 0, len(self.grid) - 2)
        since, drive = time - self.time[piece], self._drive[piece]
        rate = np.maximum(np.sqrt(self.square[piece]) + drive * since, 0.0)
        way = 0.5 * (np.sqrt(self.square[piece]) + rate) * since
        s = self.grid[piece] + np.clip(way, 0.0, self._width[piece])
        first, second = self.spline(s, 1), self.spline(s, 2)
        square, drive, rate = (part[:, np.newaxis] for part in (rate**2, drive, rate))
        return self.spline(s), first * rate, second * square + first * drive

    def largest(self) -> tuple[np.ndarray, np.ndarray]:
        """Largest speed [rad/s] and acceleration [rad/s^2] of each joint over the whole motion
        (nq,), also between the points of the grid."""
        start, width, drive = self.grid[:-1], self._width[:, None], self._drive[:, None]
        knot = np.searchsorted(self.spline.x, start + 0.5 * self._width, "right") - 1
        first, second = self.spline(start, 1), self.spline(start, 2)
        third = 6.0 * self.spline.c[0, knot]
        square = self.square[:-1, np.newaxis]
        # qdd = a + b r + c r^2 at r behind the point of the grid
        a = second * square + first * drive
        b = 3.0 * drive * second + third * square
        c = 2.5 * drive * third
        with np.errstate(divide="ignore", invalid="ignore"):
            vertex = -0.5 * b / c
            root = np.sqrt(b**2 - 4.0 * a * c)
            zeros = [(-b + root) / (2.0 * c), (-b - root) / (2.0 * c), -a / b]
        speed = acceleration = np.zeros(first.shape[1])
        for place in (np.zeros_like(a), np.broadcast_to(width, a.shape), vertex, *zeros):
            r = np.where(np.isfinite(place) & (place >= 0.0) & (place <= width), place, 0.0)
            rate = np.sqrt(np.maximum(square + 2.0 * drive * r, 0.0))
            passing = np.abs((first + second * r + 0.5 * third * r**2) * rate)
            speed = np.maximum(speed, passing.max(axis=0))
            acceleration = np.maximum(acceleration, np.abs(a + b * r + c * r**2).max(axis=0))
        return speed, acceleration

    def slowed(self, factor: float) -> TimedSpline:
        """The same, ``factor`` times as long: speeds fall by it, accelerations by its square."""
        return replace(self, square=self.square / factor**2)

    def away_from_chords(self) -> float:
        """Largest distance of q(s) from the chord between two knots at the same s, of any joint,
        over all s [rad]."""
        width = np.diff(self.spline.x)[:, np.newaxis]
        c3, c2, c1 = self.spline.c[:3]
        slope = (self.spline.c[3] - self.spline(self.spline.x[1:])) / width + c1
        with np.errstate(divide="ignore", invalid="ignore"):
            root = np.sqrt(c2**2 - 3.0 * c3 * slope)
            places = [(-c2 + root) / (3.0 * c3), (-c2 - root) / (3.0 * c3), -0.5 * slope / c2]
        worst = 0.0
        for place in places:
            r = np.where(np.isfinite(place) & (place >= 0.0) & (place <= width), place, 0.0)
            worst = max(worst, float(np.abs(((c3 * r + c2) * r + slope) * r).max()))
        return worst
