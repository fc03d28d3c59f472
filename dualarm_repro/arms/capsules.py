"""Capsules of an arm as coal geometry fixed to the joints of its model."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
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
    made = []
    for k, one in enumerate(capsules):
        name, ends = f"capsule_{k}_joint_{one.joint}", (np.array(one.start), np.array(one.end))
        made.append(LinkCapsule(name, one.joint, *ends, one.radius))
    return geometry_of(made)


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
        found.append(LinkCapsule(shape.name, shape.parentJoint, *ends, radius))
    return geometry_of(not_contained(found))


@dataclass(frozen=True, eq=False)
class LinkCapsule:
    """A capsule in the frame of its joint."""

    name: str
    joint: int
    start: np.ndarray
    end: np.ndarray
    radius: float

    def inside(self, other: LinkCapsule, rounding: float = ROUNDING) -> bool:
        """Whether it lies in another one: its two end balls do, and capsules are convex."""
        if self.joint != other.joint:
            return False
        gap = to_segment(np.array([self.start, self.end]), other.start, other.end).max()
        return bool(gap + self.radius <= other.radius + rounding)


def not_contained(capsules: Sequence[LinkCapsule]) -> list[LinkCapsule]:
    """Those that lie in no other one; of some that lie in each other, the first."""

    def kept(k: int, one: LinkCapsule) -> bool:
        around = [(j, other) for j, other in enumerate(capsules) if j != k and one.inside(other)]
        return all(other.inside(one) and j > k for j, other in around)

    return [one for k, one in enumerate(capsules) if kept(k, one)]


def geometry_of(capsules: Iterable[LinkCapsule]) -> pin.GeometryModel:
    """Coal capsules in the frames of their joints, without collision pairs."""
    geometry = pin.GeometryModel()
    for one in capsules:
        placement, shape = segment_capsule(one.start, one.end, one.radius)
        geometry.addGeometryObject(pin.GeometryObject(one.name, one.joint, placement, shape))
    return geometry


def capsule_ends(placement: pin.SE3, shape: coal.Capsule) -> tuple[np.ndarray, np.ndarray]:
    """Start and end of the core of a capsule at a placement (3,) [m]."""
    half = np.array([0.0, 0.0, shape.halfLength])
    return placement.act(-half), placement.act(half)


def to_segment(points: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Distances (N,) of points (N, 3) to a segment [m]."""
    along = end - start
    square = along @ along
    share = ((points - start) @ along / square).clip(0.0, 1.0) if square else np.zeros(len(points))
    return np.linalg.norm(points - start - share[:, None] * along, axis=1)


def _enclose(shape: coal.CollisionGeometry) -> tuple[np.ndarray, np.ndarray, float]:
    if isinstance(shape, coal.Sphere):
        return np.zeros(3), np.zeros(3), shape.radius
    if isinstance(shape, coal.Capsule | coal.Cylinder):
        half = np.array([0.0, 0.0, shape.halfLength])
        return -half, half, shape.radius
    return _enclose_points(corners(shape))


def corners(shape: coal.CollisionGeometry) -> np.ndarray:
    """Corners of a box, or vertices of a mesh (N, 3) [m]; UnsupportedArmError for another shape."""
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
