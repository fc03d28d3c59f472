"""Measures of chatter along z, each as a multiple of the level above which it is called chatter."""

from __future__ import annotations

import numpy as np

WINDOW = 20
_LEVELS = {"sign_changes": 0.25, "second_difference": 0.5, "peak_to_peak": 0.005}


def chatter(z: np.ndarray, measure: str) -> float:
    """Chatter in the last searches of a run over its level; above one it counts.

    ``sign_changes``: share of steps against the one before; ``second_difference``: its mean size
    over that of the first difference; ``peak_to_peak``: spread about a running mean of five [m].
    """
    tail = z[-(WINDOW + 5) :]
    steps = np.diff(tail)
    if measure == "sign_changes":
        value = float(np.mean(steps[1:] * steps[:-1] < 0))
    elif measure == "second_difference":
        value = float(np.abs(np.diff(steps)).mean() / max(np.abs(steps).mean(), 1e-12))
    else:
        trend = np.convolve(tail, np.full(5, 0.2), mode="valid")
        value = float(np.ptp(tail[2:-2] - trend))
    return value / _LEVELS[measure]
