"""Signed distance, witness points and normal of a sphere or capsule and another shape."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np

from ..arguments import LATER, checked
from ..errors import InputError
from .hull import ConvexHull
from .pair_kernels import capsules_boxes, capsules_capsules, capsules_hull, capsules_planes
from .shapes import Box, Capsule, HalfSpace, Shape, Sphere, not_a_shape

_PAIR = np.array([[0, 1]])
_FIRST = np.zeros((1, 2), dtype=np.int64)


class Witness(NamedTuple):
    """Where two shapes are nearest, or the shortest way out of each other.

    ``point_b = point_a + distance * normal``; the unit normal points from a to b in the sense that
    moving b along it lengthens the distance at unit rate, in contact and penetration as well.
    """

    distance: float
    point_a: np.ndarray
    point_b: np.ndarray
    normal: np.ndarray

    def swapped(self) -> Witness:
        """The same with a and b exchanged."""
        return Witness(self.distance, self.point_b, self.point_a, -self.normal)


@checked
def signed_distance(a: Annotated[Shape, LATER], b: Annotated[Shape, LATER]) -> Witness:
    """d(a, b): length of the shortest gap, or minus that of the shortest separating translation.

    The translation is the shortest one of a relative to b after which they only touch (penetration
    depth). All distances are closed forms or finite searches, exact to rounding.

    Raises
    ------
    InputError
        Neither shape is a sphere or a capsule.
    """
    if not isinstance(a, Sphere | Capsule | Box | HalfSpace | ConvexHull):
        raise not_a_shape("signed_distance", a, "a")
    if not isinstance(a, Sphere | Capsule):
        if not isinstance(b, Sphere | Capsule):
            names = f"{type(a).__name__}, {type(b).__name__}"
            raise InputError("signed_distance", "shapes", names, "a sphere or capsule among them")
        return signed_distance(b, a).swapped()
    distance, witness = np.empty((1, 1)), np.empty((1, 1, 3, 3))
    ends, radius = a.core[np.newaxis, np.newaxis], np.array([a.radius])
    match b:
        case Sphere() | Capsule():
            ends, radius = np.stack([a.core, b.core])[np.newaxis], np.array([a.radius, b.radius])
            capsules_capsules(ends, radius, _PAIR, distance, witness, 0)
        case Box():
            boxes = b.pose[np.newaxis, np.newaxis], b.half[np.newaxis]
            capsules_boxes(ends, radius, *boxes, _FIRST, distance, witness, 0)
        case HalfSpace():
            capsules_planes(ends, radius, b.plane[np.newaxis], _FIRST, distance, witness, 0)
        case ConvexHull():
            pose = np.eye(3, 4)[np.newaxis, np.newaxis]
            capsules_hull(ends, radius, pose, b.polytope, 0, _FIRST, distance, witness, 0)
        case _:
            raise not_a_shape("signed_distance", b, "b")
    return Witness(float(distance[0, 0]), *witness[0, 0])
