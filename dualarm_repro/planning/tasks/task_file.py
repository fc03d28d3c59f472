"""Task files: which arms of a scene go where, in YAML.

Either a scene file whose arms have ``start`` and ``goal``, or a file of its own::

    scene: cell.yaml            # beside this file
    tasks:                      # in the order of planning: the first arm is the master
      left: {start: [0, 0, 0, 0, 0, 0], goal: ["-pi/2", 0, 0, 0, "45 deg", 0]}
      right:
        start: {position: [0.75, 0.35, 0.5], tool: radial, elbow: up}
        goal: {position: [-0.45, 0.8, 0.15], tool: radial, elbow: up}
    settings: {...}             # of the method; by default they suit the size of each arm
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Generic, Literal, TypeVar, overload

import numpy as np
from pydantic import Discriminator, Field, Tag, model_validator

from ...datafiles import StrictModel, read_yaml
from ...errors import DataFileError, InputError
from ...scene import PlacedArm, Scene, load_scene
from ...scene.scene_file import Name, Number, Point, Radians
from ...settings import Settings
from ..master_slave import MasterPoints
from ..settings import APFSettings, PointSet
from .postures import Elbow, Tool, posture
from .tip_goal import REACHED, tip_posture

Joints = list[Radians]
_Settings = TypeVar("_Settings", bound=Settings)
_Settings_co = TypeVar("_Settings_co", bound=Settings, covariant=True)


class PostureEntry(StrictModel):
    """A flange position, and what else the posture is to fulfil."""

    position: Point
    tool: Tool | Point | None = Field(default=None, description="without: any direction will do")
    elbow: Elbow | None = Field(default=None, description="only with tool")
    last_joint: Radians = Field(default=0.0, description="only with tool")
    reference: Joints | None = Field(
        default=None, description="of several postures take the nearest"
    )
    best_effort: bool = Field(
        default=False, description="go as near as the arm can; only without tool"
    )

    @model_validator(mode="after")
    def _one_way(self) -> PostureEntry:
        if self.best_effort and self.tool is not None:
            raise ValueError("best_effort without tool")
        return self

    def configuration(self, placed: PlacedArm) -> tuple[np.ndarray, float]:
        """Joint vector of an arm, and by how much it misses the position [m]."""
        if self.tool is None:
            near = np.zeros(placed.arm.nq) if self.reference is None else self.reference
            found = tip_posture(placed, self.position, near, best_effort=self.best_effort)
            return found.q, found.residual if found.residual > REACHED else 0.0
        q = posture(
            placed,
            self.position,
            self.tool,
            elbow=self.elbow,
            last_joint=self.last_joint,
            reference=self.reference,
        )
        return q, 0.0


# Told apart beforehand, so that an error speaks of what was meant.
Configuration = Annotated[
    Annotated[Joints, Tag("joints")] | Annotated[PostureEntry, Tag("posture")],
    Discriminator(lambda value: "joints" if isinstance(value, list) else "posture"),
]


class TaskEntry(StrictModel):
    """Of one arm; what is left out is taken from the scene file."""

    start: Configuration | None = None
    goal: Configuration | None = None


class TaskFile(StrictModel):
    """Content of a task file."""

    scene: str = Field(min_length=1, description="path of the scene file, from this file")
    tasks: dict[Name, TaskEntry] = Field(min_length=1)
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
    """Start and goal of one arm (nq,) [rad], and by how much the goal misses its point [m]."""

    start: np.ndarray
    goal: np.ndarray
    residual: float = 0.0


@dataclass(frozen=True, eq=False)
class TaskSet(Generic[_Settings_co]):
    """A scene and the tasks in it; ``settings`` is None if the file has none."""

    scene: Scene
    tasks: dict[str, ReadTask]
    settings: _Settings_co | None
    leave_out: tuple[str, ...]
    master_points: MasterPoints
    radius: float | None


@overload
def load_tasks(path: str | Path) -> TaskSet[APFSettings]:
    """With settings of the potential field planners."""


@overload
def load_tasks(path: str | Path, kind: type[_Settings]) -> TaskSet[_Settings]:
    """With settings of that kind."""


def load_tasks(path: str | Path, kind: type[Settings] = APFSettings) -> TaskSet[Settings]:
    """Read a task file, or a scene file whose arms have start and goal.

    Parameters
    ----------
    kind : type
        Of the settings.

    Raises
    ------
    DataFileError
        With the offending field; also for a position out of reach or an arm without task.
    """
    path = Path(path)
    content = read_yaml(path)
    if "scene" not in content:
        scene = load_scene(path)
        entries = {placed.name: TaskEntry() for placed in scene.arms if placed.goal is not None}
        if not entries:
            raise DataFileError(path, "arms", list(scene.columns), "an arm with start and goal")
        file = TaskFile(scene=path.name, tasks=entries)
    else:
        file = TaskFile.checked(path, content)
        scene = load_scene(path.parent / file.scene)
    return TaskSet(
        scene,
        {name: _task(path, scene, name, entry) for name, entry in file.tasks.items()},
        _settings(path, kind, file.settings),
        tuple(file.leave_out),
        file.master_points,
        file.radius,
    )


def json_schema() -> dict[str, Any]:
    """JSON Schema of a task file, for editors and other tools."""
    return TaskFile.model_json_schema()


def _task(path: Path, scene: Scene, name: str, entry: TaskEntry) -> ReadTask:
    placed = next((placed for placed in scene.arms if placed.name == name), None)
    if placed is None:
        raise DataFileError(path, "tasks", name, f"one of {', '.join(scene.columns)}")
    ends = {}
    for field in ("start", "goal"):
        value = getattr(entry, field)
        value = getattr(placed, field) if value is None else value
        if value is None:
            expected = "a joint vector or a position, here or in the scene file"
            raise DataFileError(path, f"tasks.{name}.{field}", None, expected)
        try:
            posed = isinstance(value, PostureEntry)
            found, missed = value.configuration(placed) if posed else (value, 0.0)
            ends[field] = placed.arm.configurations(found)
        except InputError as error:
            place = f"tasks.{name}.{field}: {error.field}"
            raise DataFileError(path, place, error.value, error.expected) from None
    return ReadTask(**ends, residual=missed)


def _settings(path: Path, kind: type[Settings], values: dict[str, Any] | None) -> Settings | None:
    try:
        return None if values is None else kind(**values)
    except InputError as error:
        field = f"settings: {error.source}.{error.field}"
        raise DataFileError(path, field, error.value, error.expected) from None
