"""RRT-Connect with shortcuts in compiled code, beside OMPL's with its simplification.

OMPL looks at the same capsules with the same margin by ``pin.computeCollisions``, every 0.02 rad.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from importlib.util import find_spec
from itertools import cycle

import numpy as np
from equal_work import DifferentWork
from ompl_paths import ompl_path, ompl_path_in_turn
from pinocchio_checks import checker, free_path, length
from planning_scenes import MARGIN, blocked_tasks, one_arm, two_arms
from timing import OURS, Row, timed

from dualarm_repro.baselines.compiled_sampling import (
    rrt_connect_compiled,
    rrt_connect_compiled_in_turn,
)
from dualarm_repro.planning.planner import FoundPath, PathProblem, PlannerSettings
from dualarm_repro.scene import Scene

TASKS = 6
ALONE, TURNS, TOGETHER = "path, one arm", "path, two arms in turn", "path, 12 joints at once"
OMPL = "OMPL RRT-Connect, simplified"
_LONGER = 1.1  # times the path of the peer, at most
_SEEDS = 3  # of each task, by which paths are compared
Planned = Callable[[np.ndarray, np.ndarray, int], np.ndarray | None]


def measure() -> Iterator[Row]:
    """Time per path; a peer that is not installed is left out."""
    single, pair = one_arm(), two_arms()
    yield from _rows(ALONE, single, rrt_connect_compiled, ompl_path)
    arms = list(pair.columns.values())
    in_turn = partial(_in_turn, arms)
    yield from _rows(TURNS, pair, rrt_connect_compiled_in_turn, in_turn)
    yield from _rows(TOGETHER, pair, rrt_connect_compiled, ompl_path)


def _in_turn(arms: list[slice], limits: tuple, *task: object) -> np.ndarray | None:
    return ompl_path_in_turn(limits, arms, *task)


def _rows(
    task: str,
    scene: Scene,
    planner: Callable[[PathProblem], FoundPath],
    peer: Callable[..., np.ndarray | None],
) -> Iterator[Row]:
    ends = blocked_tasks(scene, TASKS, in_turn=task == TURNS)
    free = checker(scene, MARGIN)

    def ours(start: np.ndarray, goal: np.ndarray, seed: int) -> np.ndarray | None:
        found = planner(PathProblem(scene, start, goal, PlannerSettings(seed=seed, margin=MARGIN)))
        return found.path if found.claimed else None

    def theirs(start: np.ndarray, goal: np.ndarray, seed: int) -> np.ndarray | None:
        return peer(scene.limits, start, goal, free, seed)

    def compared() -> str:
        mine, other = (_lengths(planned, ends, free) for planned in (ours, theirs))
        ratio = mine / other
        if ratio > _LONGER:
            raise DifferentWork(f"our paths are {ratio:.2f} times as long")
        return f"all solved and free, ours {ratio:.2f} times as long"

    def sound() -> str:
        _lengths(ours, ends, free)
        return "all solved and free"

    yield timed(task, OURS, _each(ours, ends), TASKS, check=sound)
    if find_spec("ompl"):
        yield timed(task, OMPL, _each(theirs, ends), TASKS, check=compared)


def _lengths(planned: Planned, ends: list, free: Callable[[np.ndarray], bool]) -> float:
    """Sum of the lengths of the paths of all tasks and seeds [rad].

    Raises
    ------
    DifferentWork
        A task is not solved, or not by a path between its ends that is free.
    """
    total = 0.0
    for start, goal in ends:
        for seed in range(_SEEDS):
            path = planned(start, goal, seed)
            if path is None:
                raise DifferentWork("a task is not solved")
            if np.abs(path[[0, -1]] - [start, goal]).max() > 1e-9 or not free_path(free, path):
                raise DifferentWork("a path is not free, or ends elsewhere")
            total += length(path)
    return total


def _each(planned: Planned, ends: list) -> Callable[[], list[np.ndarray | None]]:
    """All tasks, with the seeds that are checked by turns."""
    seeds = cycle(range(_SEEDS))

    def run() -> list[np.ndarray | None]:
        seed = next(seeds)
        return [planned(start, goal, seed) for start, goal in ends]

    return run
