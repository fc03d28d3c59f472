"""Obstacles: sphere, capsule, oriented box, half-space, and the window made of four boxes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import coal
import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from ..arguments import checked
from ..arms.capsules import segment_capsule
from ..errors import InputError
from .hull import ConvexHull
from .quantities import array_of, positive, rotation3, unit3, vector3


@dataclass(frozen=True, eq=False)
class Sphere:
    """|x - center| <= radius; center (3,) and radius in metres."""

    center: np.ndarray
    radius: float

    if TYPE_CHECKING:  # anything that makes an array is taken

        def __init__(self, center: ArrayLike, radius: float) -> None: ...

    def __post_init__(self) -> None:
        _set(self, center=vector3("Sphere", "center", self.center))
        _set(self, radius=positive("Sphere", "radius", self.radius))

    @property
    def core(self) -> np.ndarray:
        """The center twice: a segment of length zero, (2, 3)."""
        return np.stack([self.center, self.center])

    @checked
    def moved(self, placement: pin.SE3) -> Sphere:
        """The shape after a rigid motion."""
        return Sphere(placement.act(self.center), self.radius)

    def coal(self) -> tuple[coal.CollisionGeometry, coal.Transform3s]:
        """Geometry and placement for coal."""
        return coal.Sphere(self.radius), coal.Transform3s(np.eye(3), self.center)


@dataclass(frozen=True, eq=False)
class Capsule:
    """Points within ``radius`` of the segment ``start`` to ``end`` [m], which may have length 0."""

    start: np.ndarray
    end: np.ndarray
    radius: float

    if TYPE_CHECKING:  # anything that makes an array is taken

        def __init__(self, start: ArrayLike, end: ArrayLike, radius: float) -> None: ...

    def __post_init__(self) -> None:
        _set(self, start=vector3("Capsule", "start", self.start))
        _set(self, end=vector3("Capsule", "end", self.end))
        _set(self, radius=positive("Capsule", "radius", self.radius))

    @property
    def core(self) -> np.ndarray:
        """Ends of the core segment, (2, 3)."""
        return np.stack([self.start, self.end])

    @checked
    def moved(self, placement: pin.SE3) -> Capsule:
        """The shape after a rigid motion."""
        return Capsule(placement.act(self.start), placement.act(self.end), self.radius)

    def coal(self) -> tuple[coal.CollisionGeometry, coal.Transform3s]:
        """Geometry and placement for coal, whose capsule lies along z around its middle."""
        placement, shape = segment_capsule(self.start, self.end, self.radius)
        return shape, coal.Transform3s(placement.rotation, placement.translation)


@dataclass(frozen=True, eq=False)
class Box:
    """|R^T (x - center)|_i <= size_i / 2: edge lengths ``size`` (3,) [m], ``rotation`` R (3, 3)."""

    center: np.ndarray
    size: np.ndarray
    rotation: np.ndarray = field(default_factory=lambda: np.eye(3))

    if TYPE_CHECKING:  # anything that makes an array is taken

        def __init__(
            self, center: ArrayLike, size: ArrayLike, rotation: ArrayLike = ...
        ) -> None: ...

    def __post_init__(self) -> None:
        size = vector3("Box", "size", self.size)
        for k in range(3):
            positive("Box", f"size[{k}]", size[k])
        _set(self, center=vector3("Box", "center", self.center), size=size)
        _set(self, rotation=rotation3("Box", "rotation", self.rotation))

    @property
    def pose(self) -> np.ndarray:
        """Upper part (3, 4) of the transform from the frame of the box to the world."""
        return np.column_stack([self.rotation, self.center])

    @property
    def half(self) -> np.ndarray:
        """Half edge lengths (3,)."""
        return 0.5 * self.size

    @checked
    def moved(self, placement: pin.SE3) -> Box:
        """The shape after a rigid motion."""
        rotation = placement.rotation @ self.rotation
        return Box(placement.act(self.center), self.size, rotation)

    def coal(self) -> tuple[coal.CollisionGeometry, coal.Transform3s]:
        """Geometry and placement for coal."""
        return coal.Box(*self.size), coal.Transform3s(self.rotation, self.center)


@dataclass(frozen=True, eq=False)
class HalfSpace:
    """normal . x <= offset: everything below a plane.

    The normal points out of the solid and is scaled to length one; ``offset`` is the signed
    distance of the plane from the origin along it [m].
    """

    normal: np.ndarray
    offset: float

    if TYPE_CHECKING:  # anything that makes an array is taken

        def __init__(self, normal: ArrayLike, offset: float) -> None: ...

    def __post_init__(self) -> None:
        _set(self, normal=unit3("HalfSpace", "normal", self.normal))
        offset = array_of("HalfSpace", "offset", self.offset, (), "a finite number [m]")
        _set(self, offset=float(offset))

    @property
    def plane(self) -> np.ndarray:
        """Normal and offset, (4,)."""
        return np.append(self.normal, self.offset)

    @checked
    def moved(self, placement: pin.SE3) -> HalfSpace:
        """The shape after a rigid motion."""
        normal = placement.rotation @ self.normal
        return HalfSpace(normal, self.offset + normal @ placement.translation)

    def coal(self) -> tuple[coal.CollisionGeometry, coal.Transform3s]:
        """Geometry and placement for coal."""
        return coal.Halfspace(self.normal, self.offset), coal.Transform3s()


Shape = Sphere | Capsule | Box | HalfSpace | ConvexHull


def not_a_shape(source: str, value: object, name: str = "shape") -> InputError:
    """The error for something that is none of the shapes."""
    return InputError(source, name, value, "Sphere, Capsule, Box, HalfSpace or ConvexHull")


def _set(shape: object, **values: object) -> None:
    for name, value in values.items():
        object.__setattr__(shape, name, value)


@checked
def facing(normal: ArrayLike, up: ArrayLike = (0.0, 0.0, 1.0)) -> np.ndarray:
    """Rotation with columns width, height, normal; the height is the part of ``up`` normal to it.

    Raises
    ------
    InputError
        ``up`` is parallel to ``normal``, or one of them is zero.
    """
    z = unit3("facing", "normal", normal)
    width = np.cross(unit3("facing", "up", up), z)
    if np.linalg.norm(width) < 1e-9:
        raise InputError("facing", "up", up, "a direction not parallel to the normal")
    x = width / np.linalg.norm(width)
    return np.column_stack([x, np.cross(z, x), z])


@checked
def window_frame(
    center: ArrayLike,
    rotation: ArrayLike,
    opening_width: float,
    opening_height: float,
    bar_width: float,
    bar_depth: float,
) -> tuple[Box, Box, Box, Box]:
    """Four bars around a rectangular opening: top, bottom, left, right, without overlap.

    Parameters
    ----------
    center : (3,)
        Middle of the opening [m].
    rotation : (3, 3)
        Columns: width and height direction and normal of the opening, e.g. of :func:`facing`.
    opening_width, opening_height : float
        Clear size [m]; top and bottom also span the bars at their sides.
    bar_width, bar_depth : float
        Section of a bar in the plane of the window and along its normal [m].
    """
    center = vector3("window_frame", "center", center)
    R = rotation3("window_frame", "rotation", rotation)
    width = positive("window_frame", "opening_width", opening_width)
    height = positive("window_frame", "opening_height", opening_height)
    bar = positive("window_frame", "bar_width", bar_width)
    depth = positive("window_frame", "bar_depth", bar_depth)
    up, side = 0.5 * (height + bar) * R[:, 1], 0.5 * (width + bar) * R[:, 0]
    lying, standing = (width + 2 * bar, bar, depth), (bar, height, depth)
    return (
        Box(center + up, lying, R),
        Box(center - up, lying, R),
        Box(center - side, standing, R),
        Box(center + side, standing, R),
    )
