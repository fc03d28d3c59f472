"""Scene files: arms on their bases, tools, obstacles that stand or move, and floor in YAML.

Lengths are metres in the world frame, angles radians, ``"90 deg"`` or multiples of pi such as
``"-pi/2"``; ``rpy`` is R = Rz(yaw) Ry(pitch) Rx(roll).
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, NamedTuple

import pinocchio as pin
from pydantic import Field

from ..arguments import checked
from ..arms import Arm, load_arm
from ..arms.shapes import Shapes
from ..datafiles import StrictModel
from ..errors import DataFileError, DualArmError, InputError
from ..input_files import path_of
from ..written import read_written
from .bodies import PlacedArm
from .configuration_entry import Configuration
from .moving import MovingShape, PosePath
from .quantity_entries import UPRIGHT, BodyName, Name, Number, Point, Radians, Rpy, pose_of
from .scene import Scene
from .shape_entries import ObstacleEntry, SolidEntry
from .shapes import Shape
from .tool import with_tool

#: Most obstacles of a scene.
MOST_OBSTACLES = 10_000
#: Largest index of a trajectory; planners look at every step up to it.
LONGEST = 100_000


class TipEntry(StrictModel):
    """Pose of the tool centre point in the frame of the flange."""

    xyz: Point = (0.0, 0.0, 0.0)
    rpy: Rpy = UPRIGHT


class ToolEntry(StrictModel):
    """What an arm holds: shapes in the frame of its flange, and where its tip is."""

    shapes: list[SolidEntry] = Field(
        default=[], max_length=50, description="each is watched as the capsule around it"
    )
    tip: TipEntry | None = Field(
        default=None, description="positions and poses of goals are then those of the tip"
    )


class ArmEntry(StrictModel):
    """An arm on its base."""

    robot: str = Field(
        min_length=1, description="name in data/robots, or path from the scene file to URDF/YAML"
    )
    xyz: Point = (0.0, 0.0, 0.0)
    rpy: Rpy = UPRIGHT
    flange: str | None = Field(default=None, description="only for a URDF: frame used as flange")
    lock: dict[str, Radians] | None = Field(
        default=None,
        description="only for a URDF: joint: angle, of a prismatic one length [m], it is fixed at",
    )
    shapes: Shapes | None = Field(
        default=None, description="only for a URDF: fitted (default), enclosing, visual or none"
    )
    packages: list[str] = Field(
        default=[],
        description="only for a URDF: folders, from the scene file, that hold its packages",
    )
    tool: ToolEntry | None = Field(default=None, description="a tool or a part that it carries")
    start: Configuration | None = Field(
        default=None, description="where a plan starts, or where the arm is parked"
    )
    goal: Configuration | None = Field(default=None, description="where a plan ends")


class WaypointEntry(StrictModel):
    """A pose at an index that all motions of a scene share: a step of the plan, or a time."""

    at: Annotated[Number, Field(ge=0, le=LONGEST)]
    xyz: Point = (0.0, 0.0, 0.0)
    rpy: Rpy = UPRIGHT


class MovingEntry(StrictModel):
    """A shape whose frame passes waypoints, linear in between and held before and after."""

    shape: SolidEntry
    path: list[WaypointEntry] = Field(min_length=1)


class SceneFile(StrictModel):
    """Content of a scene file."""

    arms: dict[Name, ArmEntry] = Field(min_length=1)
    obstacles: dict[Name, ObstacleEntry] = Field(default_factory=dict)
    moving: dict[Name, MovingEntry] = Field(default_factory=dict)
    floor: Number | None = Field(default=None, description="height of a floor")
    exempt: list[tuple[BodyName, BodyName]] = Field(
        default=[], description="pairs that may touch: arms, ARM/LINK, obstacles or single bodies"
    )
    self_collision: bool = True


class WrittenScene(NamedTuple):
    """A scene and what its file says, which holds starts and goals that are no joint vectors."""

    file: SceneFile
    scene: Scene


@checked
def load_scene(path: str | Path) -> Scene:
    """Read a scene file.

    Starts and goals given as joint vectors come with the arms; those given as positions or poses
    are for ``dualarm_repro.planning.load_tasks``.

    Raises
    ------
    DataFileError
        With the offending field, its value and what was expected; also for an unknown robot, a
        robot file that is wrong itself, or a name that two bodies share.
    UnsupportedArmError
        A robot is no serial chain of joints that the library knows.
    """
    path = path_of("load_scene", "path", path)
    return scene_of(path, read_written(path)).scene


def scene_of(path: Path, content: dict[str, Any]) -> WrittenScene:
    """The scene of a file whose content has been read; errors as in :func:`load_scene`."""
    counted = content.get("obstacles")
    if isinstance(counted, dict) and len(counted) > MOST_OBSTACLES:
        expected = f"at most {MOST_OBSTACLES} obstacles"
        raise DataFileError(path, "obstacles", len(counted), expected)
    file = SceneFile.checked(path, content)
    arms = [_placed(path, name, entry) for name, entry in file.arms.items()]
    obstacles = {n: _shapes(path, f"obstacles.{n}", one) for n, one in file.obstacles.items()}
    moving = {name: _moving(path, name, entry) for name, entry in file.moving.items()}
    try:
        scene = Scene(
            arms,
            {n: found[0] if len(found) == 1 else found for n, found in obstacles.items()},
            moving=moving,
            floor=file.floor,
            exempt=file.exempt,
            self_collision=file.self_collision,
        )
    except InputError as error:
        raise DataFileError(path, error.field, error.value, error.expected) from None
    return WrittenScene(file, scene)


def placed_arms(path: Path, content: dict[str, Any]) -> list[PlacedArm]:
    """The arms of such a file without their scene; errors as in :func:`load_scene`."""
    file = SceneFile.checked(path, content)
    return [_placed(path, name, entry) for name, entry in file.arms.items()]


def json_schema() -> dict[str, Any]:
    """JSON Schema of a scene file, for editors and other tools."""
    return SceneFile.model_json_schema()


def _placed(path: Path, name: str, entry: ArmEntry) -> PlacedArm:
    beside = path.parent / entry.robot
    try:
        robot: Path | str = beside if beside.is_file() else entry.robot
        folders = [path.parent / folder for folder in entry.packages]
        options = {"flange": entry.flange, "lock": entry.lock, "shapes": entry.shapes}
        loaded = load_arm(robot, **options, packages=folders)  # type: ignore[arg-type]
        arm = _with_tool(path, name, entry, loaded)
        ends = (q if isinstance(q, list) else None for q in (entry.start, entry.goal))
        return PlacedArm(name, arm, pose_of(entry.xyz, entry.rpy), *ends)
    except DataFileError:
        raise
    except InputError as error:
        field = f"arms.{name}: {error.field}"
        raise DataFileError(path, field, error.value, error.expected) from None
    except DualArmError:
        raise
    except (ValueError, RuntimeError, IndexError, OSError) as error:  # of a library below
        expected = "a robot that can be loaded"
        raise DataFileError(
            path, f"arms.{name}.robot", f"{entry.robot}: {error}", expected
        ) from None


def _with_tool(path: Path, name: str, entry: ArmEntry, arm: Arm) -> Arm:
    if entry.tool is None:
        return arm
    shapes: list[Shape] = []
    for k, one in enumerate(entry.tool.shapes):
        shapes += _shapes(path, f"arms.{name}.tool.shapes.{k}", one)
    tip = entry.tool.tip
    return with_tool(arm, shapes, tip and pose_of(tip.xyz, tip.rpy))


def _shapes(path: Path, field: str, entry: Any) -> tuple[Shape, ...]:
    try:
        return entry.shapes(path.parent)
    except DataFileError:
        raise
    except InputError as error:
        raise DataFileError(path, f"{field}.{error.field}", error.value, error.expected) from None


def _moving(path: Path, name: str, entry: MovingEntry) -> MovingShape:
    shapes = _shapes(path, f"moving.{name}.shape", entry.shape)
    if len(shapes) > 1:
        expected = "1: what moves is one convex body"
        raise DataFileError(path, f"moving.{name}.shape.parts", len(shapes), expected)
    poses: list[pin.SE3] = [pose_of(one.xyz, one.rpy) for one in entry.path]
    try:
        return MovingShape(shapes[0], PosePath(poses, [one.at for one in entry.path]))  # type: ignore[arg-type]
    except InputError as error:
        field = f"moving.{name}.path.{error.field}"
        raise DataFileError(path, field, error.value, error.expected) from None
