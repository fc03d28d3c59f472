"""Capsules of an arm as coal geometry fixed to the joints of its model."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product

import coal
import numpy as np
import pinocchio as pin

from ..errors import UnsupportedArmError
from .robot_file import Capsule

ROUNDING = 1e-4  # a capsule that sticks out of another one by less [m] counts as inside it


def capsule_geometry(capsules: Iterable[Capsule]) -> pin.GeometryModel:
    """One coal capsule per entry, in the joint frame it names; adds no collision pair."""
    geometry = pin.GeometryModel()
    for k, capsule in enumerate(capsules):
        placement, shape = segment_capsule(
            np.array(capsule.start), np.array(capsule.end), capsule.radius
        )
        name = f"capsule_{k}_joint_{capsule.joint}"
        geometry.addGeometryObject(pin.GeometryObject(name, capsule.joint, placement, shape))
    return geometry


def segment_capsule(
    start: np.ndarray, end: np.ndarray, radius: float
) -> tuple[pin.SE3, coal.Capsule]:
    """Placement and shape of the capsule around a segment; coal's axis is z, about the middle."""
    axis = end - start
    length = float(np.linalg.norm(axis))
    z = axis / length if length > 0 else np.array([0.0, 0.0, 1.0])
    rotation = pin.Quaternion.FromTwoVectors(np.array([0.0, 0.0, 1.0]), z).matrix()
    return pin.SE3(rotation, 0.5 * (start + end)), coal.Capsule(radius, length)


def enclosing_capsules(shapes: pin.GeometryModel) -> pin.GeometryModel:
    """A capsule around every shape, fixed to the same joint; one inside another is left out.

    A sphere, a capsule and a cylinder keep their radius and axis; around the corners of a box or
    mesh the axis is the direction of largest spread, the radius and the ends are the smallest for
    that axis.

    Raises
    ------
    UnsupportedArmError
        A shape is none of these.
    """
    found = []
    for shape in shapes.geometryObjects:
        start, end, radius = _enclose(shape.geometry)
        ends = shape.placement.act(start), shape.placement.act(end)
        found.append(_Enclosing(shape.name, shape.parentJoint, *ends, radius))
    geometry = pin.GeometryModel()
    for k, capsule in enumerate(found):
        inside = [other for other in found if other is not capsule and capsule.inside(other)]
        if all(other.inside(capsule) and found.index(other) > k for other in inside):
            placement, shape = segment_capsule(capsule.start, capsule.end, capsule.radius)
            geometry.addGeometryObject(
                pin.GeometryObject(capsule.name, capsule.joint, placement, shape)
            )
    return geometry


@dataclass(frozen=True, eq=False)
class _Enclosing:
    """A capsule in the frame of its joint."""

    name: str
    joint: int
    start: np.ndarray
    end: np.ndarray
    radius: float

    def inside(self, other: _Enclosing) -> bool:
        """Whether it lies in another one: its two end balls do, and capsules are convex."""
        axis = other.end - other.start
        square = axis @ axis
        for point in (self.start, self.end):
            along = np.clip((point - other.start) @ axis / square, 0.0, 1.0) if square > 0 else 0.0
            gap = np.linalg.norm(point - other.start - along * axis)
            if self.joint != other.joint or gap + self.radius > other.radius + ROUNDING:
                return False
        return True


def _enclose(shape: coal.CollisionGeometry) -> tuple[np.ndarray, np.ndarray, float]:
    if isinstance(shape, coal.Sphere):
        return np.zeros(3), np.zeros(3), shape.radius
    if isinstance(shape, coal.Capsule | coal.Cylinder):
        half = np.array([0.0, 0.0, shape.halfLength])
        return -half, half, shape.radius
    return _enclose_points(_corners(shape))


def _corners(shape: coal.CollisionGeometry) -> np.ndarray:
    if isinstance(shape, coal.Box):
        return shape.halfSide * np.array(list(product((-1.0, 1.0), repeat=3)))
    if isinstance(shape, coal.BVHModelBase):
        return np.array(shape.vertices())
    if isinstance(shape, coal.ConvexBase):
        return np.array(shape.points())
    raise UnsupportedArmError(f"no capsule is known for the shape {type(shape).__name__}")


def _enclose_points(points: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    _, directions = np.linalg.eigh(np.cov(points.T))
    across, along = points @ directions[:, :2], points @ directions[:, 2]
    centre = 0.5 * (across.min(axis=0) + across.max(axis=0))
    radius = float(np.linalg.norm(across - centre, axis=1).max())
    bulge = np.sqrt(radius**2 - np.sum((across - centre) ** 2, axis=1).clip(max=radius**2))
    low, high = (along + bulge).min(), (along - bulge).max()
    if low > high:
        low = high = 0.5 * (low + high)
    ends = [directions @ np.append(centre, end) for end in (low, high)]
    return ends[0], ends[1], radius
