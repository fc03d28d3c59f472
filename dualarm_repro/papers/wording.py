"""Numbers in captions."""

from __future__ import annotations

import numpy as np


def point(values: np.ndarray, digits: int = 4) -> str:
    """Coordinates as "x, y, z", without negative zeros."""
    return ", ".join(f"{value + 0.0:.{digits}f}" for value in np.round(values, 12))
