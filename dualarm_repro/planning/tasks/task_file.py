"""Task files: which arms of a scene go where, in YAML.

Either a scene file whose arms have ``start`` and ``goal``, or a file of its own::

    scene: cell.yaml            # beside this file
    tasks:                      # in the order of planning: the first arm is the master
      left: {start: [0, 0, 0, 0, 0, 0], goal: ["-pi/2", 0, 0, 0, "45 deg", 0]}
      right:
        start: {position: [0.75, 0.35, 0.5], tool: radial, elbow: up}
        goal: {position: [-0.45, 0.8, 0.15], rpy: [0, pi, 0], free: z}
    parked:                     # arms without a task; by default at their start in the scene file
      third: [0, 0, 0, 0, 0, 0]
    settings: {...}             # of the method; what is left out suits the size of each arm
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Generic, Literal, TypeVar, overload

import numpy as np
from pydantic import Field

from ...arguments import checked
from ...arms import Arm
from ...datafiles import StrictModel
from ...errors import DataFileError, InputError
from ...input_files import path_of
from ...scene import Scene, distances
from ...scene.broad_phase import with_arms
from ...scene.configuration_entry import Configuration, PostureEntry
from ...scene.quantity_entries import Name, Number
from ...scene.scene_file import SceneFile, placed_arms, scene_of
from ...settings import Settings
from ...written import read_written
from ..defaults import default_settings, default_two_arm_settings
from ..faults import TaskFaults
from ..given_settings import merged
from ..master_slave import MasterPoints
from ..search.bidirectional_arms import TwoArmSettings
from ..settings import APFSettings, PointSet
from .configuration import joints_of

_Settings = TypeVar("_Settings", bound=Settings)
_Settings_co = TypeVar("_Settings_co", bound=Settings, covariant=True)
#: Settings that suit an arm, by their kind.
_DEFAULTS: dict[type[Settings], Callable[[Arm], Settings]] = {
    APFSettings: default_settings,
    TwoArmSettings: default_two_arm_settings,
}


class TaskEntry(StrictModel):
    """Of one arm; what is left out is taken from the scene file."""

    start: Configuration | None = None
    goal: Configuration | None = None


class TaskFile(StrictModel):
    """Content of a task file."""

    scene: str = Field(min_length=1, description="path of the scene file, from this file")
    tasks: dict[Name, TaskEntry] = Field(min_length=1)
    parked: dict[Name, Configuration] = Field(
        default={}, description="where arms without a task stand; default their start in the scene"
    )
    settings: dict[str, Any] | None = Field(
        default=None, description="see the schema of the method"
    )
    leave_out: list[Name] = Field(default=[], description="obstacles the planner is not told about")
    master_points: Literal["joint_points"] | PointSet | list[int] = Field(
        default="joint_points", description="what of an arm repels those planned after it"
    )
    radius: Annotated[Number, Field(ge=0)] | None = Field(
        default=None, description="of these points"
    )


@dataclass(frozen=True, eq=False)
class ReadTask:
    """Start and goal of one arm (nq,) [rad], and by how much the goal misses its point [m].

    A continuous joint of the goal is given as the angle nearest to that of the start.
    ``posture`` is what the goal has to fulfil where the file gives no joint vector.
    """

    start: np.ndarray
    goal: np.ndarray
    residual: float = 0.0
    posture: PostureEntry | None = None


@dataclass(frozen=True, eq=False)
class TaskSet(Generic[_Settings_co]):
    """A scene and the tasks in it.

    Attributes
    ----------
    settings : mapping of arm to Settings
        What the file gives, merged over what suits the arm; of the arms with a task.
    parked : dict of arm to (nq,)
        Where the arms without a task stand [rad].
    """

    scene: Scene
    tasks: dict[str, ReadTask]
    settings: Mapping[str, _Settings_co]
    leave_out: tuple[str, ...]
    master_points: MasterPoints
    radius: float | None
    parked: dict[str, np.ndarray] = field(default_factory=dict)
    path: Path = Path("task file")

    @property
    def starts(self) -> dict[str, np.ndarray]:
        """Where every arm of the scene is at first (nq,) [rad]."""
        return self.parked | {name: task.start for name, task in self.tasks.items()}

    @property
    def goals(self) -> dict[str, np.ndarray]:
        """Where every arm of the scene is to be at last (nq,) [rad]."""
        return self.parked | {name: task.goal for name, task in self.tasks.items()}


@overload
def load_tasks(path: str | Path) -> TaskSet[APFSettings]:
    """With settings of the potential field planners."""


@overload
def load_tasks(
    path: str | Path,
    kind: type[_Settings],
    default: Callable[[Arm], _Settings] | None = None,
    goals_needed: bool = True,
) -> TaskSet[_Settings]:
    """With settings of that kind."""


@checked
def load_tasks(
    path: str | Path,
    kind: type[Settings] = APFSettings,
    default: Callable[[Arm], Settings] | None = None,
    goals_needed: bool = True,
) -> TaskSet[Settings]:
    """Read a task file, or a scene file whose arms have start and goal.

    Parameters
    ----------
    kind : type
        Of the settings; :class:`.Settings` itself: those of the file are left alone.
    default : callable, optional
        Arm -> settings that suit it, over which those of the file are merged.
    goals_needed : bool
        Whether a scene without any goal is refused.

    Raises
    ------
    DataFileError
        With the offending field; also for a position out of reach or an arm without task.
    TaskFaults
        The same for several fields at once.
    """
    path = path_of("load_tasks", "path", path)
    content = read_written(path)
    if not content.keys() & {"scene", "tasks"}:
        written, scene = scene_of(path, content)
        entries = {n: TaskEntry() for n, arm in written.arms.items() if arm.goal is not None}
        if not entries and goals_needed:
            raise DataFileError(path, "arms", list(scene.columns), "an arm with start and goal")
        file = TaskFile.model_construct(scene=path.name, tasks=entries)
    else:
        file = TaskFile.checked(path, content)
        beside = path.parent / file.scene
        written, scene = scene_of(beside, read_written(beside))
    reading = _Reading(path, scene, written)
    tasks = reading.tasks(file)
    parked = reading.parked(file)
    if reading.faults:
        raise reading.faults[0] if len(reading.faults) == 1 else TaskFaults(reading.faults)
    chosen = default or _DEFAULTS.get(kind)
    arms = {placed.name: placed.arm for placed in scene.arms}
    given = file.settings or {}
    return TaskSet(
        scene,
        tasks,
        {n: _settings(path, chosen(arms[n]), given) for n in tasks} if chosen else {},
        tuple(file.leave_out),
        file.master_points,
        file.radius,
        parked,
        path,
    )


def arms_and_ends(path: Path) -> list[tuple[Arm, bool]]:
    """The arms of a file of tasks, and of each whether its start or goal is given as a position.

    Neither is the scene put together nor are the tasks read further: of a file that
    :func:`load_tasks` refuses it may give something, or raise anything.
    """
    content = read_written(path)
    tasks: dict[str, Any] = {}
    if content.keys() & {"scene", "tasks"}:
        file = TaskFile.checked(path, content)
        tasks, path = dict(file.tasks), path.parent / file.scene
        content = read_written(path)
    found = []
    for placed in placed_arms(path, content):
        task, entry = tasks.get(placed.name), content["arms"][placed.name]
        ends = [getattr(task, end, None) or entry.get(end) for end in ("start", "goal")]
        found.append((placed.arm, any(isinstance(e, dict | PostureEntry) for e in ends)))
    return found


def json_schema() -> dict[str, Any]:
    """JSON Schema of a task file, for editors and other tools."""
    return TaskFile.model_json_schema()


class _Reading:
    """Turns entries of a file into joint vectors, and collects what is wrong with them."""

    def __init__(self, path: Path, scene: Scene, written: SceneFile) -> None:
        self._path, self._scene, self._written = path, scene, written
        self._placed = {placed.name: placed for placed in scene.arms}
        self.faults: list[InputError] = []

    def tasks(self, file: TaskFile) -> dict[str, ReadTask]:
        """Start and goal of each arm with a task."""
        found = {}
        for name, entry in file.tasks.items():
            if self._unknown("tasks", name):
                continue
            ends, value = {}, None
            for end in ("start", "goal"):
                value = getattr(entry, end)
                value = getattr(self._written.arms[name], end) if value is None else value
                expected = "a joint vector or a position, here or in the scene file"
                ends[end] = self._joints(name, f"tasks.{name}.{end}", value, expected)
            start, goal = ends["start"], ends["goal"]
            if start and goal:
                posed = value if isinstance(value, PostureEntry) else None
                at = self._placed[name].arm.nearest(goal[0], start[0])
                found[name] = ReadTask(start[0], at, residual=goal[1], posture=posed)
        return found

    def parked(self, file: TaskFile) -> dict[str, np.ndarray]:
        """Where the arms without a task stand."""
        found = {}
        for name in file.parked:
            if not self._unknown("parked", name) and name in file.tasks:
                self._fault(f"parked.{name}", "a task", "an arm without a task")
        for name in self._placed if set(file.tasks) <= set(self._placed) else ():
            if name in file.tasks:
                continue
            value = file.parked.get(name, self._written.arms[name].start)
            expected = (
                "where the arm is parked: a start in the scene file, or `parked` in a task file"
            )
            if read := self._joints(name, f"arms.{name}.start", value, expected):
                found[name] = read[0]
        return found

    def _unknown(self, field_name: str, name: str) -> bool:
        if name not in self._placed:
            self._fault(field_name, name, f"one of {', '.join(self._placed)}")
        return name not in self._placed

    def _joints(
        self, name: str, place: str, value: Any, expected: str
    ) -> tuple[np.ndarray, float] | None:
        if value is None:
            self._fault(place, None, expected)
            return None
        try:
            return joints_of(self._placed[name], value, self._clear(name))
        except InputError as error:
            self._fault(f"{place}: {error.field}", error.value, error.expected)
            return None

    def _clear(self, name: str) -> Callable[[np.ndarray], bool]:
        """Whether an arm alone touches nothing that stands, nor itself."""
        alone = with_arms(self._scene, [name])
        return lambda q: bool((distances(alone, q) > 0.0).all())

    def _fault(self, place: str, value: Any, expected: str) -> None:
        self.faults.append(DataFileError(self._path, place, value, expected))


def _settings(path: Path, default: _Settings, given: Mapping[str, Any]) -> _Settings:
    try:
        return merged(default, given)
    except InputError as error:
        place = f"settings: {error.source}.{error.field}"
        raise DataFileError(path, place, error.value, error.expected) from None
