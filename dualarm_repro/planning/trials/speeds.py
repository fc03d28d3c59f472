"""The speed of a motion per instant, whatever it is measured in."""

from __future__ import annotations

import numpy as np


def mean_advance(points: np.ndarray, index: np.ndarray) -> float:
    """Length of a track (N, n) over the instants (N,) it takes: (N, 3) in space [m], or (N, nq) in
    the joints [rad]."""
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum() / index[-1])
