"""An arm that notes every call of its closed-form inverse kinematics."""

from __future__ import annotations

import copy

from .arm import Arm


def counting_inverse(arm: Arm) -> tuple[Arm, list[None]]:
    """A copy of the arm, and a list that grows by one entry with every call of ``ik_branches``."""
    counted, calls = copy.copy(arm), []

    def noted(*args: object, **options: object) -> object:
        calls.append(None)
        return arm.ik_branches(*args, **options)

    counted.ik_branches = noted
    return counted, calls
