"""Random configurations within the joint ranges of arms."""

from __future__ import annotations

import numpy as np

from .system import ArmSystem


def random_configuration(system: ArmSystem, rng: np.random.Generator) -> np.ndarray:
    """Joint angles (n,) uniform in their ranges, at most half a turn either way [rad]."""
    arrays = system.arrays
    return rng.uniform(arrays.lower.clip(min=-np.pi), arrays.upper.clip(max=np.pi))
