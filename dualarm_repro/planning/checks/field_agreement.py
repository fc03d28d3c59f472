"""A potential against its own gradient by central differences."""

from __future__ import annotations

import numpy as np

from ...differences import central_differences
from ..field.potentials import Potential

_STEP = 1e-5  # of the differences [rad]


def gradient_error(potential: Potential, q: np.ndarray) -> float:
    """Largest |dU/dq - central differences of U| / max(1, |dU/dq|) at configurations (N, nq)."""
    worst = 0.0
    for row in q:
        exact, slopes = potential.gradient(row), central_differences(potential.value, row, _STEP)
        worst = max(worst, float(abs(slopes - exact).max() / max(1.0, abs(exact).max())))
    return worst
