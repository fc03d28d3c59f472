"""The shapes that a scene file can name, each as an entry that makes the shape."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from ..datafiles import StrictModel
from ..errors import InputError
from .hull import ConvexHull, circle_points
from .mesh_parts import mesh_parts
from .quantity_entries import UPRIGHT, Length, Number, Point, Rpy, Size, pose_of
from .shapes import Box, Capsule, HalfSpace, Shape, Sphere, facing, window_frame

#: Sides of the prism around a cylinder; it sticks out by less than half a per cent of the radius.
_SIDES = 32


class SphereEntry(StrictModel):
    """A ball."""

    kind: Literal["sphere"]
    center: Point
    radius: Length

    def shapes(self, folder: Path) -> tuple[Shape, ...]:
        """The obstacle."""
        return (Sphere(self.center, self.radius),)


class CapsuleEntry(StrictModel):
    """Everything within a radius of a segment."""

    kind: Literal["capsule"]
    start: Point
    end: Point
    radius: Length

    def shapes(self, folder: Path) -> tuple[Shape, ...]:
        """The obstacle."""
        return (Capsule(self.start, self.end, self.radius),)


class CylinderEntry(StrictModel):
    """A cylinder with flat ends, as the prism of 32 sides around it."""

    kind: Literal["cylinder"]
    start: Point = Field(description="middle of one end")
    end: Point = Field(description="middle of the other end")
    radius: Length

    def shapes(self, folder: Path) -> tuple[Shape, ...]:
        """The obstacle."""
        ends = np.array([self.start, self.end])
        axis = ends[1] - ends[0]
        if not np.linalg.norm(axis) > 0:
            raise InputError("cylinder", "end", self.end, "a point apart from the start")
        around = np.full(2, self.radius / np.cos(np.pi / _SIDES))
        return (ConvexHull(circle_points(ends, [axis, axis], around, _SIDES)),)


class BoxEntry(StrictModel):
    """A box with full edge lengths."""

    kind: Literal["box"]
    center: Point
    size: Size
    rpy: Rpy = UPRIGHT

    def shapes(self, folder: Path) -> tuple[Shape, ...]:
        """The obstacle."""
        return (Box(self.center, self.size, pose_of(self.center, self.rpy).rotation),)


class HalfSpaceEntry(StrictModel):
    """Everything below a plane, e.g. a wall."""

    kind: Literal["halfspace"]
    normal: Point
    offset: Number

    def shapes(self, folder: Path) -> tuple[Shape, ...]:
        """The obstacle."""
        return (HalfSpace(self.normal, self.offset),)


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

    def shapes(self, folder: Path) -> tuple[Shape, ...]:
        """The obstacle."""
        sizes = (self.opening_width, self.opening_height, self.bar_width, self.bar_depth)
        return window_frame(self.center, facing(self.normal, self.up), *sizes)


class HullEntry(StrictModel):
    """Convex hull of points."""

    kind: Literal["hull"]
    points: list[Point] = Field(min_length=4, max_length=2000)

    def shapes(self, folder: Path) -> tuple[Shape, ...]:
        """The obstacle."""
        return (ConvexHull(self.points),)


class MeshEntry(StrictModel):
    """A mesh file, as convex parts that contain its surface."""

    kind: Literal["mesh"]
    file: str = Field(min_length=1, description="path of an STL, OBJ, DAE or PLY, from this file")
    xyz: Point = (0.0, 0.0, 0.0)
    rpy: Rpy = UPRIGHT
    scale: Length | Size = Field(default=1.0, description="factor of the file's lengths to metres")
    parts: Annotated[int, Field(strict=True, ge=1, le=64)] = Field(
        default=16, description="most convex parts; 1: the convex hull of the mesh"
    )

    def shapes(self, folder: Path) -> tuple[Shape, ...]:
        """The obstacle."""
        scale = self.scale if isinstance(self.scale, tuple) else (self.scale,) * 3
        found = mesh_parts((folder / self.file).resolve(), scale, self.parts)
        pose = pose_of(self.xyz, self.rpy)
        return tuple(part.moved(pose) for part in found)


SolidEntry = Annotated[
    SphereEntry | CapsuleEntry | CylinderEntry | BoxEntry | HullEntry | MeshEntry,
    Field(discriminator="kind"),
]
ObstacleEntry = Annotated[
    SphereEntry
    | CapsuleEntry
    | CylinderEntry
    | BoxEntry
    | HalfSpaceEntry
    | WindowEntry
    | HullEntry
    | MeshEntry,
    Field(discriminator="kind"),
]
