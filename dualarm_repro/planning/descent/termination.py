"""When a plan ends, and why: tolerances, trap detection, named reasons."""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from ...kernel import kernel
from ...settings import code
from ..settings import StuckRule

_BLOCK_MEANS = code(StuckRule.BLOCK_MEANS)


class StopReason(StrEnum):
    """Why a plan ended.

    ``NEAR_OBSTACLE``: the arm rests close to its goal, at which an obstacle repels it.
    """

    REACHED = "reached"
    TRAPPED = "trapped"
    NEAR_OBSTACLE = "goal-not-reachable-near-obstacle"
    STEP_LIMIT = "step-limit"


@kernel
def within(joint_error, position_error, joint_tolerance, position_tolerance):
    """Whether both errors are within their tolerances (infinite: not demanded)."""
    return joint_error <= joint_tolerance and position_error <= position_tolerance


@kernel
def is_stuck(rule, steps, threshold, path, potential, since, step):
    """Whether the arm has stood still, by one of two rules, at ``step``.

    ``block_means``: |mean(q_(s-b+1) ... q_s) - mean(q_(s-2b+1) ... q_(s-b))|_inf < threshold,
    looked at when a block of b steps since ``since`` is full; chatter between two points is found
    too. ``potential_stall``: U_(s-b) - U_s < threshold, looked at once all b steps lie after
    ``since``.

    Parameters
    ----------
    path : (S, nq), potential : (S,)
        Rows up to ``step`` are read.
    since : int
        Step of the last change of the potential, or of the start.
    """
    walked = step - since
    if rule == _BLOCK_MEANS:
        if walked < 2 * steps or walked % steps:
            return False
        for j in range(path.shape[1]):
            change = 0.0
            for k in range(steps):
                change += path[step - k, j] - path[step - steps - k, j]
            if abs(change) >= threshold * steps:
                return False
        return True
    return walked > steps and potential[step - steps] - potential[step] < threshold


def largest_joint_error(q: np.ndarray, goal: np.ndarray) -> float | np.ndarray:
    """max_j |q_j - q_gj| [rad]."""
    return np.abs(q - goal).max(axis=-1)
