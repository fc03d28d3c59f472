"""The search for a task to show: draws in a row, judged at the control rate, the smoothest wins."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from .motion import Motion
from .random_tasks import FOLLOWED, CircleTask, admissible, draw_task, naive_motion
from .settings import ControllerSettings
from .simulate import simulate
from .system import ArmSystem

#: Distance that a naive motion has to fall below to collide deeply [m].
DEEP = -0.05
#: What an avoiding motion may fall short of the inner range, and be off its path [m].
KEPT, TRACKED = 5e-4, 5e-5
#: Angle by which a naive motion has to leave the joint ranges [rad].
FAR = 0.1


class Wanted(NamedTuple):
    """What a search looks for, in words, as a property of the naive and of the avoiding motion."""

    words: str
    naive: Callable[[ArmSystem, Motion, ControllerSettings], bool]
    avoiding: Callable[[Motion, ControllerSettings], bool]


class FoundTask(NamedTuple):
    """The task of least peak acceleration, its draw, and how many were admissible."""

    task: CircleTask
    draw: int
    among: int


def score(
    system: ArmSystem, task: CircleTask, wanted: Wanted, settings: ControllerSettings
) -> float | None:
    """Peak acceleration of the avoiding motion [rad/s^2]; None if the task is not wanted."""
    if not wanted.naive(system, naive_motion(system, task, settings), settings):
        return None
    motion = simulate(system, task.circles(system), task.q0, settings)
    return motion.peak_acceleration if wanted.avoiding(motion, settings) else None


def search_task(
    system: ArmSystem,
    wanted: Wanted,
    draws: int,
    seed: int,
    radii: tuple[float, float],
    settings: ControllerSettings | None = None,
) -> FoundTask | None:
    """The wanted task of least peak acceleration, draw k from the stream [seed, k].

    Parameters
    ----------
    radii
        Range of the radius of the circles [m].

    Returns
    -------
    FoundTask or None
        None if no draw is wanted.
    """
    settings, found = settings or ControllerSettings(), []
    for draw in range(draws):
        task = draw_task(system, np.random.default_rng([seed, draw]), radii)
        peak = score(system, task, wanted, settings)
        if peak is not None:
            found.append((peak, draw, task))
    if not found:
        return None
    _, draw, task = min(found, key=lambda one: one[:2])
    return FoundTask(task, draw, len(found))


def _clean(motion: Motion, settings: ControllerSettings) -> bool:
    kept = motion.completed and motion.smallest_distance >= settings.inner - KEPT
    return kept and motion.largest_error <= TRACKED


def _collides(system: ArmSystem, naive: Motion, settings: ControllerSettings) -> bool:
    return admissible(naive, settings) and naive.smallest_distance <= DEEP


def _leaves(system: ArmSystem, naive: Motion, settings: ControllerSettings) -> bool:
    return admissible(naive, settings) and naive.angle_excess >= FAR


def _inside(system: ArmSystem, naive: Motion, settings: ControllerSettings) -> bool:
    return 0.0 < naive.distance[0] < 0.5 * settings.inner and naive.largest_error <= FOLLOWED


CROSSING = Wanted(
    "a task on which naive motion collides deeply and avoidance completes.", _collides, _clean
)
TO_LIMITS = Wanted(
    "a task on which naive motion leaves the joint ranges and the arms come close.",
    _leaves,
    lambda motion, settings: _clean(motion, settings) and motion.rows.max() > 0,
)
TOO_CLOSE = Wanted(
    "a task that starts inside the inner range, without contact, and is completed.",
    _inside,
    lambda motion, settings: motion.completed,
)
