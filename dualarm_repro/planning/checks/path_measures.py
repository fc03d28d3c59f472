"""What a path looks like, whatever its length: chatter of a coordinate, bending, where it rests."""

from __future__ import annotations

import numpy as np

#: Steps over which chatter is measured, and the rest of a path.
WINDOW = 20
MEASURES = ("sign_changes", "second_difference", "peak_to_peak")


def chatter(z: np.ndarray, measure: str, step: float) -> float:
    """Chatter of a coordinate (n,) in its last steps: 0 for a straight slope, 1 for a full zigzag.

    ``sign_changes``: share of steps against the one before; ``second_difference``: half its mean
    size over that of the first difference; ``peak_to_peak``: spread about a running mean of five
    over ``step``, the way in one step that counts as a full one, in the unit of ``z``.
    """
    tail = z[-(WINDOW + 5) :]
    steps = np.diff(tail)
    if measure == "sign_changes":
        return float(np.mean(steps[1:] * steps[:-1] < 0))
    if measure == "second_difference":
        return float(0.5 * np.abs(np.diff(steps)).mean() / max(np.abs(steps).mean(), 1e-12))
    trend = np.convolve(tail, np.full(5, 0.2), mode="valid")
    return float(np.ptp(tail[2:-2] - trend) / step)


def bending(path: np.ndarray, spacing: float) -> float:
    """Mean squared curvature int |x''(s)|^2 ds / L of the polygon through the rows of ``path``.

    The path (N, n) is resampled at equal arc lengths s, about ``spacing`` apart in its own unit, so
    that the lengths of its steps do not matter [1/unit^2].
    """
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    count = max(int(lengths[-1] / spacing), 4)
    at = np.linspace(0.0, lengths[-1], count + 1)
    even = np.stack([np.interp(at, lengths, column) for column in path.T], axis=1)
    step = lengths[-1] / count
    second = np.diff(even, 2, axis=0) / step**2
    return float((second**2).sum(axis=1).mean())


def until_rest(path: np.ndarray, step: float, window: int = WINDOW) -> int:
    """Number of the row after which a path (N, n) stays within two steps of its mean end.

    ``step`` is in the unit of the path; the end is the mean of the last ``window`` rows.
    """
    rest = path[-window:].mean(axis=0)
    away = np.linalg.norm(path - rest, axis=1) > 2.0 * step
    return int(np.flatnonzero(away)[-1]) + 1 if away.any() else 0
