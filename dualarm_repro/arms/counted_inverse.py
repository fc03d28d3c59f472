"""An arm that notes every call of its closed-form inverse kinematics."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np

from .arm import Arm


def counting_inverse(arm: Arm) -> tuple[Arm, list[None]]:
    """A copy of the arm, and a list that grows by one entry with every call of ``ik_branches``."""
    counted = copy.copy(arm)
    calls: list[None] = []

    def noted(*args: Any, **options: Any) -> np.ndarray:
        calls.append(None)
        return arm.ik_branches(*args, **options)

    counted.ik_branches = noted  # type: ignore[method-assign]
    return counted, calls
