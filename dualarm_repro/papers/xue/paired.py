"""Means over random arrangements, of the difference of two methods in the same arrangement."""

from __future__ import annotations

import numpy as np

#: 97.5 % point of the standard normal distribution.
_Z = 1.959963984540054


def mean_with_interval(values: np.ndarray) -> dict[str, float | int]:
    """Mean (N,), its 95 % interval mean +- 1.96 s / sqrt(N), and N.

    The sample of arrangements is large, so that its mean is close to normal.
    """
    values = np.asarray(values, dtype=float)
    mean = float(values.mean())
    half = float(_Z * values.std(ddof=1) / np.sqrt(len(values)))
    return {"value": mean, "low": mean - half, "high": mean + half, "of": len(values)}
