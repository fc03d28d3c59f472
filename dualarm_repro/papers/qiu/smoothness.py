"""How much a path bends, whatever the length of its steps: for comparing methods with each other.

int |x''(s)|^2 ds / L over the arc length s [1/unit^2], of the path resampled at equal arc lengths.
"""

from __future__ import annotations

import numpy as np


def bending(path: np.ndarray, spacing: float) -> float:
    """Mean squared curvature of the polygon through the rows of ``path`` (N, n)."""
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    count = max(int(lengths[-1] / spacing), 4)
    at = np.linspace(0.0, lengths[-1], count + 1)
    even = np.stack([np.interp(at, lengths, column) for column in path.T], axis=1)
    step = lengths[-1] / count
    second = np.diff(even, 2, axis=0) / step**2
    return float((second**2).sum(axis=1).mean())


def until_rest(path: np.ndarray, step: float, window: int = 20) -> int:
    """Number of the row after which a path stays within two steps of its mean end."""
    rest = path[-window:].mean(axis=0)
    away = np.linalg.norm(path - rest, axis=1) > 2.0 * step
    return int(np.flatnonzero(away)[-1]) + 1 if away.any() else 0
