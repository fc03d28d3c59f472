"""Joint ranges of arms: random configurations within them, and how far a motion leaves them."""

from __future__ import annotations

import numpy as np

from .system import ArmSystem


def random_configuration(system: ArmSystem, rng: np.random.Generator) -> np.ndarray:
    """Joint angles (n,) uniform in their ranges, at most half a turn either way [rad]."""
    arrays = system.arrays
    return rng.uniform(arrays.lower.clip(min=-np.pi), arrays.upper.clip(max=np.pi))


def angle_excess(system: ArmSystem, q: np.ndarray) -> float:
    """Largest excess of joint angles (N, n) over their limits, negative inside [rad]."""
    arrays = system.arrays
    return float(max((q - arrays.upper).max(), (arrays.lower - q).max()))


def speed_excess(system: ArmSystem, x: np.ndarray) -> float:
    """Largest excess of joint velocities (N, n) over their limits, negative inside [rad/s]."""
    return float((np.abs(x) - system.arrays.speed).max())
