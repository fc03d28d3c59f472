"""Edges proved free, beside Pinocchio's collision checks of states along them.

The peer looks at the same capsules with the same margin by ``pin.computeCollisions`` (stop at the
first contact), at states 0.02 rad apart; it proves nothing between them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from equal_work import DifferentWork, reference
from pinocchio_checks import checker, free_motion
from planning_scenes import MARGIN, one_arm, two_arms
from timing import OURS, Row, timed

from dualarm_repro.scene import Scene
from dualarm_repro.scene.edges import free_edges

EDGES, LONGEST = 256, 0.4  # [rad]
_EQUAL = 0.98  # share of the edges that must be judged alike
_SCENES = {
    "edge validity, one arm": one_arm,
    "edge validity, two arms with 12 joints": two_arms,
}


def measure() -> Iterator[Row]:
    """Time per edge, half of them free or more."""
    for task, made in _SCENES.items():
        scene, rng = made(), np.random.default_rng(0)
        starts = rng.uniform(*scene.limits, (EDGES, scene.nq))
        ends = starts + rng.uniform(-LONGEST, LONGEST, starts.shape)
        yield from _rows(task, scene, starts, ends)


def _rows(task: str, scene: Scene, starts: np.ndarray, ends: np.ndarray) -> Iterator[Row]:
    free = checker(scene, MARGIN)

    def proved() -> np.ndarray:
        return free_edges(scene, starts, ends, MARGIN)

    def sampled() -> np.ndarray:
        return np.array([free_motion(free, a, b) for a, b in zip(starts, ends, strict=True)])

    yield timed(task, OURS, proved, EDGES, check=reference())
    name = "pin.computeCollisions every 0.02 rad"
    yield timed(task, name, sampled, EDGES, check=same_edges(proved, sampled))


def same_edges(
    proved: Callable[[], np.ndarray], sampled: Callable[[], np.ndarray]
) -> Callable[[], str]:
    """What is proved free is free for the peer too, and nearly all edges are judged alike: a peer
    that samples oversees contacts, and a proof may fail where the margin is just kept."""

    def check() -> str:
        ours, theirs = proved(), sampled()
        if (ours & ~theirs).any():
            raise DifferentWork(f"{(ours & ~theirs).sum()} proved edges are not free for the peer")
        alike = float((ours == theirs).mean())
        if alike < _EQUAL:
            raise DifferentWork(f"only {alike:.1%} of the edges are judged alike")
        return f"{alike:.1%} judged alike, all proved ones free"

    return check
