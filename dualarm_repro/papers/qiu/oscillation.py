"""Measures of chatter along z, each as a share of what a full zigzag of the printed step gives."""

from __future__ import annotations

import numpy as np

from .scenario import ALPHA0, reach

WINDOW = 20


def chatter(z: np.ndarray, measure: str) -> float:
    """Chatter in the last searches of a run: 0 for a straight slope, 1 for a full zigzag.

    ``sign_changes``: share of steps against the one before; ``second_difference``: half its mean
    size over that of the first difference; ``peak_to_peak``: spread about a running mean of five
    over the way of the straight arm's flange in one printed step.
    """
    tail = z[-(WINDOW + 5) :]
    steps = np.diff(tail)
    if measure == "sign_changes":
        return float(np.mean(steps[1:] * steps[:-1] < 0))
    if measure == "second_difference":
        return float(0.5 * np.abs(np.diff(steps)).mean() / max(np.abs(steps).mean(), 1e-12))
    trend = np.convolve(tail, np.full(5, 0.2), mode="valid")
    return float(np.ptp(tail[2:-2] - trend) / (ALPHA0 * reach()))
