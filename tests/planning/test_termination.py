"""Trap detection: what counts as standing still, and what does not."""

import numpy as np
import pytest

from dualarm_repro.planning import StopReason, StuckRule
from dualarm_repro.planning.descent.termination import is_stuck, within
from dualarm_repro.settings import code

BLOCKS, STALL = code(StuckRule.BLOCK_MEANS), code(StuckRule.POTENTIAL_STALL)


def found(rule, steps, threshold, path, potential=None, since=0):
    """Steps at which the rule calls the arm stuck."""
    path = np.array(path, dtype=float).reshape(len(path), -1)
    potential = np.zeros(len(path)) if potential is None else np.array(potential, dtype=float)
    return [
        step
        for step in range(len(path))
        if is_stuck(rule, steps, threshold, path, potential, since, step)
    ]


def test_an_arm_at_rest_is_found_after_two_blocks_and_then_at_every_block():
    assert found(BLOCKS, 5, 1e-3, np.zeros(31)) == [10, 15, 20, 25, 30]
    assert found(BLOCKS, 5, 1e-3, np.zeros(31), since=7) == [17, 22, 27]


def test_chatter_is_standing_still_but_slow_motion_is_not():
    chatter = 0.1 * (-1.0) ** np.arange(31)
    assert found(BLOCKS, 10, 1e-3, chatter) == [20, 30]
    assert found(BLOCKS, 5, 1e-3, 3e-4 * np.arange(31)) == []


def test_every_joint_must_rest():
    path = np.zeros((21, 3))
    path[:, 1] = 1e-3 * np.arange(21)
    assert found(BLOCKS, 5, 1e-3, path) == []
    assert found(BLOCKS, 5, 1e-2, path) == [10, 15, 20]


def test_a_potential_that_no_longer_falls():
    falling = np.maximum(10.0 - np.arange(30), 4.0)
    assert found(STALL, 3, 1e-6, np.zeros(30), falling)[0] == 9
    rising = np.arange(30.0)
    assert found(STALL, 3, 1e-6, np.zeros(30), rising, since=5)[0] == 9


def test_tolerances_that_are_not_demanded_always_hold():
    assert within(5.0, 0.01, np.inf, 0.02)
    assert not within(5.0, 0.03, np.inf, 0.02)
    assert not within(0.1, 0.0, 0.05, np.inf)


@pytest.mark.parametrize("reason", list(StopReason))
def test_reasons_read_as_written(reason):
    assert str(reason) in {
        "reached",
        "trapped",
        "goal-not-reachable-near-obstacle",
        "step-limit",
    }
