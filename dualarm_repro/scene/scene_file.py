"""Scene files: arms on their bases, obstacles and floor in YAML.

Lengths are metres in the world frame, angles radians, ``"90 deg"`` or multiples of pi such as
``"-pi/2"``; ``rpy`` is R = Rz(yaw) Ry(pitch) Rx(roll).
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import pinocchio as pin
from pydantic import BeforeValidator, Field, StringConstraints

from ..arms import load_arm
from ..arms.angle import EXPECTED, Angle
from ..arms.shapes import Shapes
from ..datafiles import StrictModel, read_yaml
from ..errors import DataFileError, InputError
from .bodies import PlacedArm
from .hull import ConvexHull
from .scene import Scene
from .shapes import Box, Capsule, HalfSpace, Shape, Sphere, facing, window_frame

Name = Annotated[str, StringConstraints(pattern=r"^[A-Za-z][A-Za-z0-9_-]*$")]
BodyName = Annotated[str, StringConstraints(min_length=1)]
Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Length = Annotated[float, Field(strict=True, gt=0, allow_inf_nan=False)]
Radians = Annotated[
    float,
    BeforeValidator(lambda value: float(Angle.parse(value))),
    Field(description=EXPECTED, json_schema_extra={"type": ["number", "string"]}),
]
Point = tuple[Number, Number, Number]
Size = tuple[Length, Length, Length]
Rpy = tuple[Radians, Radians, Radians]
_UPRIGHT = (0.0, 0.0, 0.0)


class SphereEntry(StrictModel):
    """A ball."""

    kind: Literal["sphere"]
    center: Point
    radius: Length

    def shape(self) -> Sphere:
        """The obstacle."""
        return Sphere(self.center, self.radius)


class CapsuleEntry(StrictModel):
    """Everything within a radius of a segment."""

    kind: Literal["capsule"]
    start: Point
    end: Point
    radius: Length

    def shape(self) -> Capsule:
        """The obstacle."""
        return Capsule(self.start, self.end, self.radius)


class BoxEntry(StrictModel):
    """A box with full edge lengths."""

    kind: Literal["box"]
    center: Point
    size: Size
    rpy: Rpy = _UPRIGHT

    def shape(self) -> Box:
        """The obstacle."""
        return Box(self.center, self.size, pin.rpy.rpyToMatrix(*self.rpy))


class HalfSpaceEntry(StrictModel):
    """Everything below a plane, e.g. a wall."""

    kind: Literal["halfspace"]
    normal: Point
    offset: Number

    def shape(self) -> HalfSpace:
        """The obstacle."""
        return HalfSpace(self.normal, self.offset)


class WindowEntry(StrictModel):
    """Four bars around an opening: top, bottom, left, right."""

    kind: Literal["window"]
    center: Point
    normal: Point
    up: Point = (0.0, 0.0, 1.0)
    opening_width: Length
    opening_height: Length
    bar_width: Length
    bar_depth: Length

    def shape(self) -> tuple[Box, ...]:
        """The obstacle."""
        sizes = (self.opening_width, self.opening_height, self.bar_width, self.bar_depth)
        return window_frame(self.center, facing(self.normal, self.up), *sizes)


class HullEntry(StrictModel):
    """Convex hull of points."""

    kind: Literal["hull"]
    points: list[Point] = Field(min_length=4)

    def shape(self) -> ConvexHull:
        """The obstacle."""
        return ConvexHull(self.points)


class ArmEntry(StrictModel):
    """An arm on its base."""

    robot: str = Field(
        min_length=1, description="name in data/robots, or path from the scene file to URDF/YAML"
    )
    xyz: Point = (0.0, 0.0, 0.0)
    rpy: Rpy = _UPRIGHT
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
    start: list[Radians] | None = Field(default=None, description="joint vector a plan starts from")
    goal: list[Radians] | None = Field(default=None, description="joint vector a plan ends at")


Obstacle = Annotated[
    SphereEntry | CapsuleEntry | BoxEntry | HalfSpaceEntry | WindowEntry | HullEntry,
    Field(discriminator="kind"),
]


class SceneFile(StrictModel):
    """Content of a scene file."""

    arms: dict[Name, ArmEntry] = Field(min_length=1)
    obstacles: dict[Name, Obstacle] = Field(default_factory=dict)
    floor: Number | None = Field(default=None, description="height of a floor")
    exempt: list[tuple[BodyName, BodyName]] = Field(
        default=[], description="pairs of bodies or owners that may touch"
    )
    self_collision: bool = True


def load_scene(path: str | Path) -> Scene:
    """Read a scene file.

    Raises
    ------
    DataFileError
        With the offending field, its value and what was expected; also for an unknown robot, a
        robot file that is wrong itself, or a name that two bodies share.
    UnsupportedArmError
        A robot is no serial chain of revolute joints.
    """
    path = Path(path)
    content = SceneFile.checked(path, read_yaml(path))
    arms = [_placed(path, name, entry) for name, entry in content.arms.items()]
    obstacles = {name: _shape(path, name, entry) for name, entry in content.obstacles.items()}
    try:
        return Scene(
            arms,
            obstacles,
            floor=content.floor,
            exempt=content.exempt,
            self_collision=content.self_collision,
        )
    except InputError as error:
        raise DataFileError(path, error.field, error.value, error.expected) from None


def json_schema() -> dict[str, Any]:
    """JSON Schema of a scene file, for editors and other tools."""
    return SceneFile.model_json_schema()


def _placed(path: Path, name: str, entry: ArmEntry) -> PlacedArm:
    placement = pin.SE3(pin.rpy.rpyToMatrix(*entry.rpy), np.array(entry.xyz))
    beside = path.parent / entry.robot
    robot = beside if beside.is_file() else entry.robot
    try:
        folders = [path.parent / folder for folder in entry.packages]
        options = {"flange": entry.flange, "lock": entry.lock, "shapes": entry.shapes}
        arm = load_arm(robot, **options, packages=folders)  # type: ignore[arg-type]
        return PlacedArm(name, arm, placement, entry.start, entry.goal)
    except DataFileError:
        raise
    except InputError as error:
        field = f"arms.{name}: {error.field}"
        raise DataFileError(path, field, error.value, error.expected) from None


def _shape(path: Path, name: str, entry: Any) -> Shape | tuple[Box, ...]:
    try:
        return entry.shape()
    except InputError as error:
        field = f"obstacles.{name}.{error.field}"
        raise DataFileError(path, field, error.value, error.expected) from None
