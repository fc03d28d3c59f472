"""Fitness of a position of the workpiece, 9 to 1 152 points along the seam."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from growth import Series
from weld_cell import GOOD, weld_cell

from dualarm_repro.welding import Objective, Placement

TITLE, X = "fitness of 20 positions of a weld by three arms", "points along the seam"
SIZES = tuple(9 * 2**k for k in range(8))
POSITIONS = 20


def series() -> list[Series]:
    """Ours alone."""
    return [Series("dualarm_repro", _ours, SIZES)]


def _ours(count: int) -> Callable[[], object]:
    placement = Placement(weld_cell(count), Objective())
    near = GOOD + np.random.default_rng(0).uniform(-0.03, 0.03, (POSITIONS, 3))
    if not (placement(near) > 0).all():
        raise RuntimeError("the positions of the benchmark should be feasible")
    return lambda: placement(near)
