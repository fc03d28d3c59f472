"""Parts of the shapes of an arm: a capsule, what of a shape it contains, and the hull of that."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import coal
import numpy as np
import pinocchio as pin
import scipy

from ..capsules import LinkCapsule
from .decomposition import Piece, decompose
from .triangles import surface_of, triangles_of

_NO_CORNERS = np.empty((0, 3))
_THIN = 1e-6  # volume over surface [m] of what is as good as flat


@dataclass(frozen=True, eq=False)
class Part:
    """A capsule in the frame of its joint, and what it contains of the shape it is named after.

    Attributes
    ----------
    capsule : LinkCapsule
    shape : pinocchio.GeometryObject
    triangles : ndarray (T, 3, 3) or None
        What it contains, in the frame of the shape [m]; None for all of a ball, capsule or rod.
    corners : ndarray (V, 3)
        Of the convex hull of that, of a rod of a prism around it, in the frame of the joint [m]:
        none where the hull would be the capsule or has no volume.
    """

    capsule: LinkCapsule
    shape: pin.GeometryObject
    triangles: np.ndarray | None
    corners: np.ndarray

    @cached_property
    def content(self) -> coal.CollisionGeometry:
        """The surface between the cuts of a mesh; any other shape stays whole."""
        if self.triangles is None or not isinstance(self.shape.geometry, coal.BVHModelBase):
            return self.shape.geometry
        return surface_of(self.triangles)


def parts_of(solids: pin.GeometryModel) -> list[Part]:
    """Capsules around every shape; a ball and a capsule stay as they are, and a long cylinder keeps
    its radius and its axis.

    Raises
    ------
    UnsupportedArmError
        A shape is neither of these, nor a box, a cylinder or a mesh.
    """
    found = list[Part]()
    for shape in solids.geometryObjects:
        solid = shape.geometry
        if isinstance(solid, coal.Sphere):
            found.append(_whole(shape, np.zeros(3), solid.radius))
        elif isinstance(solid, coal.Capsule) or _is_rod(solid):
            one = _whole(shape, np.array([0.0, 0.0, solid.halfLength]), solid.radius)
            if not isinstance(solid, coal.Capsule):
                corners = _corners(triangles_of(solid))
                corners = corners @ shape.placement.rotation.T + shape.placement.translation
                one = replace(one, corners=corners)
            found.append(one)
        else:
            found += _pieces(shape, decompose(triangles_of(solid)))
    return found


def _whole(shape: pin.GeometryObject, half: np.ndarray, radius: float) -> Part:
    ends = shape.placement.act(-half), shape.placement.act(half)
    return Part(LinkCapsule(shape.name, shape.parentJoint, *ends, radius), shape, None, _NO_CORNERS)


def _pieces(shape: pin.GeometryObject, pieces: list[Piece]) -> list[Part]:
    """A capsule inside another one of the same shape leaves what it contains to that."""
    made = list[tuple[LinkCapsule, list[np.ndarray]]]()
    for piece in sorted(pieces, key=lambda piece: -piece.radius):
        ends = shape.placement.act(piece.start), shape.placement.act(piece.end)
        capsule = LinkCapsule(shape.name, shape.parentJoint, *ends, piece.radius)
        around = [own for other, own in made if capsule.inside(other, 0.0)]
        if around:
            around[0].append(piece.triangles)
        else:
            made.append((capsule, [piece.triangles]))
    found = []
    for k, (capsule, own) in enumerate(made):
        name = shape.name if len(made) == 1 else f"{shape.name}.{k}"
        triangles = np.concatenate(own)
        corners = _corners(triangles)
        corners = corners @ shape.placement.rotation.T + shape.placement.translation
        found.append(Part(replace(capsule, name=name), shape, triangles, corners))
    return found


def _corners(triangles: np.ndarray) -> np.ndarray:
    points = triangles.reshape(-1, 3)
    try:
        hull = scipy.spatial.ConvexHull(points)
    except (scipy.spatial.QhullError, ValueError):  # flat
        return _NO_CORNERS
    thick = hull.volume > _THIN * hull.area
    return points[hull.vertices] if thick else _NO_CORNERS


def _is_rod(solid: coal.CollisionGeometry) -> bool:
    """Whether the ends of a capsule around a cylinder add at most a quarter to its volume."""
    return isinstance(solid, coal.Cylinder) and 4.0 / 3.0 * solid.radius <= 0.5 * solid.halfLength
