"""What `dualarm check` and `dualarm view` give away: a scene or a path, without planning."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..planning.checks.arrival import BEGUN, arrives, away_from_start
from ..planning.checks.truth import truth
from ..planning.gate import require_sound
from ..planning.tasks.path_file import read_paths
from ..planning.tasks.task_file import TaskSet, load_tasks
from ..scene import JointPath
from ..settings import Settings
from .plan_report import judged, remarks, told, usable
from .scene3d import Scene3D
from .task_scene import drawn_scene


def check_summary(
    given: TaskSet[Settings], files: list[Path], allow_collision: bool = False
) -> dict[str, Any]:
    """Certified distances along the paths of the files, or at the starts and goals of the scene.

    An arm without a path stays where the scene parks or starts it. A path that does not begin there
    is not usable: nobody knows how the arm is to get to its first row.

    Raises
    ------
    DataFileError
        A wrong file.
    TaskFaults
        Without files: bodies that touch, or joints beyond their limits, at start or goal.
    """
    if not files:
        require_sound(given.path, given.scene, given.starts, given.goals, allow_collision)
    paths = checked_paths(given, files)
    found = truth(given.scene, paths)
    arrived = {
        placed.name: arrives(placed, task, paths[placed.name].configurations[-1])
        for placed in given.scene.arms
        if (task := given.tasks.get(placed.name)) and files
    }
    reached, away = all(arrived.values()), away_from_starts(given, paths)
    arms: dict[str, dict[str, Any]] = {name: {"away_from_start": away[name]} for name in away}
    for name, value in arrived.items():
        arms[name]["reached"] = value
    begun = begins(away)
    return {
        "arms": arms,
        "begun": begun,
        "reached": reached,
        "usable": usable(found, reached, begun),
        "outcome": told(found, reached, begun),
        "remarks": remarks(given.scene),
        **judged(found),
    }


def away_from_starts(given: TaskSet[Settings], paths: Mapping[str, JointPath]) -> dict[str, float]:
    """Of every arm how far the first row of its path is from its start, largest joint [rad, m]."""
    return {
        one.name: away_from_start(one, given.starts[one.name], paths[one.name].configurations[0])
        for one in given.scene.arms
    }


def begins(away: Mapping[str, float]) -> bool:
    """Whether all of these distances are rounding."""
    return all(gap <= BEGUN for gap in away.values())


def checked_paths(given: TaskSet[Settings], files: list[Path]) -> dict[str, JointPath]:
    """A path of every arm of the scene: of the files, else where it stands at the start."""
    still = {name: JointPath([q]) for name, q in given.starts.items()}
    return still | read_paths(given.scene, files)


def check_scene(given: TaskSet[Settings], files: list[Path], title: str) -> Scene3D:
    """The scene with its arms on their paths, or at their starts, and faintly at their goals."""
    paths = checked_paths(given, files)
    index = np.unique(np.concatenate([path.index for path in paths.values()]))
    rows = {name: path.at(index) for name, path in paths.items()}
    goals = {name: task.goal for name, task in given.tasks.items()}
    return drawn_scene(given.scene, title, rows, index, goals)


def loaded(path: Path) -> TaskSet[Settings]:
    """The tasks of a file for a check: arms without a goal are parked, settings are left alone."""
    return load_tasks(path, Settings, goals_needed=False)
