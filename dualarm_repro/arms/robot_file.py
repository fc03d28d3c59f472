"""Schema of ``data/robots/<name>.yaml``: a DH table, a URDF, or the mirror image of an arm.

Lengths are numbers [m]. Angles are exact: a number [rad], ``"76 deg"`` or a multiple of pi such as
``"-pi/2"``; speeds are angles per second. Every number carries a key of ``sources`` and an evidence
tag: ``printed`` in the reproduced document, ``public`` in an opened source, ``inferred`` by
computation, ``assumed``, or ``stand-in`` for data of a similar robot.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar, get_args

from pydantic import BeforeValidator, Field, PlainSerializer, TypeAdapter, model_validator

from ..arguments import checked
from ..datafiles import StrictModel, Text
from ..errors import DataFileError
from ..written import read_written
from .angle import EXPECTED, Angle
from .shapes import Shapes

Length = Annotated[float, Field(strict=True, allow_inf_nan=False)]
ExactAngle = Annotated[
    Any,
    BeforeValidator(Angle.parse),
    PlainSerializer(float),
    Field(description=EXPECTED, json_schema_extra={"type": ["number", "string"]}),
]
Point = tuple[Length, Length, Length]
_Part = TypeVar("_Part", bound=StrictModel)
Evidence = Literal["printed", "public", "inferred", "assumed", "stand-in"]
Column = Literal["alpha", "a", "d", "offset", "lower", "upper", "velocity"]
COLUMNS: tuple[Column, ...] = get_args(Column)


def changed(part: _Part, **values: Any) -> _Part:
    """A part of a robot file with other values, which are not checked again."""
    return part.model_copy(update=values)


class Origin(StrictModel):
    """Where a number comes from."""

    source: Text = Field(description="key of sources")
    evidence: Evidence
    note: Text | None = None


class ColumnOrigin(Origin):
    """Where a column of the DH table comes from, with exceptions for single joints."""

    joints: dict[int, Origin] = Field(default={}, description="joint, from 1: its own origin")


class Joint(StrictModel):
    """One row of a DH table and the limits of its joint."""

    name: Text
    alpha: ExactAngle
    a: Length
    d: Length
    offset: ExactAngle = Field(description="theta = q + offset")
    lower: ExactAngle
    upper: ExactAngle
    velocity: ExactAngle = Field(description="largest joint speed, per second")

    @model_validator(mode="after")
    def _ordered(self) -> Joint:
        if not float(self.lower) < float(self.upper):
            raise ValueError("lower below upper")
        if not float(self.velocity) > 0:
            raise ValueError("a positive velocity")
        return self


class Flange(StrictModel):
    """Fixed transform from the last DH frame to the flange, R = Rz(yaw) Ry(pitch) Rx(roll)."""

    translation: Point
    rpy: tuple[ExactAngle, ExactAngle, ExactAngle]
    source: Text
    evidence: Evidence


class Capsule(Origin):
    """A segment with a radius, fixed to the frame of a joint (0: the base)."""

    joint: int = Field(ge=0)
    start: Point
    end: Point
    radius: float = Field(strict=True, gt=0, allow_inf_nan=False)


class _Robot(StrictModel):
    """What every robot file says."""

    title: Text
    evidence: Text = Field(description="summary of how firmly the data are known")
    notes: list[Text] = Field(default_factory=list)
    sources: dict[Text, Text] = Field(min_length=1, description="key: bibliographic text")

    def _check_sources(self, origins: list[Origin | Flange]) -> None:
        for origin in origins:
            if origin.source not in self.sources:
                raise ValueError(f"sources to hold {origin.source!r}, which an entry refers to")


class DHRobot(_Robot):
    """A serial arm of revolute joints given by its DH table."""

    kind: Literal["dh"]
    convention: Literal["modified", "standard"]
    joints: list[Joint] = Field(min_length=1)
    flange: Flange | None = None
    provenance: dict[Column, ColumnOrigin]
    capsules: list[Capsule] = Field(default_factory=list)

    @model_validator(mode="after")
    def _complete(self) -> DHRobot:
        if missing := [column for column in COLUMNS if column not in self.provenance]:
            raise ValueError(f"provenance of the columns {', '.join(missing)}")
        n = len(self.joints)
        if len({joint.name for joint in self.joints}) < n:
            raise ValueError("joint names that differ")
        for column, origin in self.provenance.items():
            if wrong := [k for k in origin.joints if not 1 <= k <= n]:
                raise ValueError(f"provenance.{column}.joints among 1..{n}, not {wrong[0]}")
        if wrong := [c.joint for c in self.capsules if c.joint > n]:
            raise ValueError(f"capsules.joint among 0..{n}, not {wrong[0]}")
        exceptions = [o for origin in self.provenance.values() for o in origin.joints.values()]
        flange = [self.flange] if self.flange else []
        self._check_sources([*self.provenance.values(), *exceptions, *self.capsules, *flange])
        return self

    def mirrored(self) -> DHRobot:
        """Reflection in the xz plane of the base: alpha, theta and the y of points change sign.

        With M = diag(1, -1, 1, 1) the mirror image at -q has the pose M T(q) M; the limits are
        therefore negated and swapped.
        """

        def flip(point: Point) -> Point:
            return (point[0], -point[1], point[2])

        joints = [
            changed(j, alpha=-j.alpha, offset=-j.offset, lower=-j.upper, upper=-j.lower)
            for j in self.joints
        ]
        capsules = [changed(c, start=flip(c.start), end=flip(c.end)) for c in self.capsules]
        flange = self.flange
        if flange:
            rpy = (-flange.rpy[0], flange.rpy[1], -flange.rpy[2])
            flange = changed(flange, translation=flip(flange.translation), rpy=rpy)
        title = f"{self.title}, mirror image"
        return changed(self, title=title, joints=joints, capsules=capsules, flange=flange)


class URDFRobot(_Robot):
    """An arm taken from a URDF file."""

    kind: Literal["urdf"]
    urdf: Text = Field(
        description="path from the robot file, or below the folder robots of example-robot-data"
    )
    flange: Text = Field(description="name of the frame used as flange")
    lock: dict[Text, ExactAngle] = Field(
        default={}, description="joint: angle it is fixed at; of a prismatic joint a length [m]"
    )
    shapes: Shapes = Field(
        default=Shapes.ENCLOSING, description="how its collision shapes become capsules"
    )
    collision: Text | None = Field(
        default=None, description="URDF of the same arm whose collision shapes are used instead"
    )
    provenance: dict[Literal["model", "limits", "capsules"], Origin]

    @model_validator(mode="after")
    def _complete(self) -> URDFRobot:
        self._check_sources(list(self.provenance.values()))
        return self


class MirrorRobot(_Robot):
    """The mirror image of another DH arm in the xz plane of its base."""

    kind: Literal["mirror"]
    of: Text = Field(description="name of the arm that is mirrored")
    provenance: dict[Literal["mirror"], Origin]

    @model_validator(mode="after")
    def _complete(self) -> MirrorRobot:
        self._check_sources(list(self.provenance.values()))
        return self


RobotFile = DHRobot | URDFRobot | MirrorRobot
_KINDS: dict[str, type[DHRobot | URDFRobot | MirrorRobot]] = {
    "dh": DHRobot,
    "urdf": URDFRobot,
    "mirror": MirrorRobot,
}


@checked
def load_robot_file(path: Path) -> RobotFile:
    """Read and check one robot file.

    Raises
    ------
    DataFileError
        With the first offending field, its value and what was expected.
    """
    content = read_written(path)
    kind = content.get("kind", "nothing")
    if not isinstance(kind, str) or kind not in _KINDS:
        raise DataFileError(path, "kind", kind, f"one of {', '.join(_KINDS)}")
    return _KINDS[kind].checked(path, content)


def json_schema() -> dict[str, Any]:
    """JSON Schema of a robot file, for editors and other tools."""
    return TypeAdapter(Annotated[RobotFile, Field(discriminator="kind")]).json_schema()
