"""All distances between the links of 1 to 4 arms around a table."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pinocchio as pin
from growth import Series

from dualarm_repro import load_arm
from dualarm_repro.scene import PlacedArm, Scene, distances

TITLE, X = "distances of all pairs of links, 1 000 configurations", "arms"
SIZES = (1, 2, 3, 4)
AROUND, CONFIGURATIONS = 0.6, 1_000  # [m, 1]


def series() -> list[Series]:
    """Ours alone."""
    return [Series("dualarm_repro", _ours, SIZES)]


def _ours(count: int) -> Callable[[], object]:
    arm, rng = load_arm("panda"), np.random.default_rng(0)
    scene = Scene([PlacedArm(f"arm{k}", arm, _base(2.0 * np.pi * k / 4)) for k in range(count)])
    q = np.hstack([arm.random_configurations(CONFIGURATIONS, rng) for _ in range(count)])
    return lambda: distances(scene, q)


def _base(angle: float) -> pin.SE3:
    """A base on a circle that faces its centre."""
    there = AROUND * np.array([np.cos(angle), np.sin(angle), 0.0])
    return pin.SE3(pin.utils.rotate("z", angle + np.pi), there)
