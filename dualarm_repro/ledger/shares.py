"""Observed shares with their confidence intervals."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

#: 97.5 % point of the standard normal distribution.
_Z = 1.959963984540054


class Share(NamedTuple):
    """An observed share and its 95 % interval."""

    value: float
    low: float
    high: float

    @classmethod
    def of(cls, count: float, total: float) -> Share:
        """Share ``count / total`` with the interval of Wilson (1927).

        Its ends solve |p - count / total| = z sqrt(p (1 - p) / total). Nothing drawn leaves
        everything possible: the interval of 0 of 0 is [0, 1] and its value NaN.
        """
        if not total:
            return cls(float("nan"), 0.0, 1.0)
        p, n = count / total, float(total)
        centre = (p + _Z**2 / (2 * n)) / (1 + _Z**2 / n)
        half = _Z * sqrt(p * (1 - p) / n + _Z**2 / (4 * n**2)) / (1 + _Z**2 / n)
        # None and all are ends themselves, which rounding may miss.
        low = 0.0 if p == 0 else max(0.0, centre - half)
        high = 1.0 if p == 1 else min(1.0, centre + half)
        return cls(float(p), low, high)
