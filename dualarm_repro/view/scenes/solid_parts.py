"""Obstacles as parts of a scene, whatever their shape, so that nothing that is judged stays
unseen."""

from __future__ import annotations

import numpy as np

from ...arms.capsules import segment_capsule
from ...scene import Box, Capsule, ConvexHull, HalfSpace, Shape, Sphere, facing
from .contents import WORLD, Part

_OPACITY = 0.8
_PATCH_OPACITY = 0.35


def solid_part(name: str, shape: Shape, color: str, node: str = WORLD) -> Part:
    """The part that draws a shape with an end, in the frame of its node."""
    pose = np.eye(4)
    match shape:
        case Sphere():
            pose[:3, 3] = shape.center
            size: tuple[float, ...] = (shape.radius, shape.radius, 0.0)
            return Part(node, "tapered", size, color, pose, _OPACITY, name)
        case Capsule():
            place, drawn = segment_capsule(shape.start, shape.end, shape.radius)
            size = (shape.radius, shape.radius, 2.0 * drawn.halfLength)
            return Part(node, "tapered", size, color, place.homogeneous, _OPACITY, name)
        case Box():
            pose[:3] = shape.pose
            return Part(node, "box", tuple(shape.size.tolist()), color, pose, 1.0, name)
        case ConvexHull():
            corners = (shape.vertices, shape.faces)
            return Part(node, "mesh", (), color, pose, 1.0, name, *corners)
        case HalfSpace():
            return half_space_part(name, shape, color, np.zeros(3), 1.0)


def half_space_part(
    name: str, shape: HalfSpace, color: str, middle: np.ndarray, size: float
) -> Part:
    """The square of edge ``size`` [m] of a plane nearest to a point (3,)."""
    turn = facing(shape.normal, (0.0, 0.0, 1.0) if abs(shape.normal[2]) < 0.9 else (1.0, 0.0, 0.0))
    at = middle + (shape.offset - shape.normal @ middle) * shape.normal
    across, along = 0.5 * size * turn[:, 0], 0.5 * size * turn[:, 1]
    corners = at + np.array([-across - along, across - along, across + along, along - across])
    faces = np.array([[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]])
    return Part(WORLD, "mesh", (), color, np.eye(4), _PATCH_OPACITY, name, corners, faces)
