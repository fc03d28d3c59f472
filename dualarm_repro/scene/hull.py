"""Convex hull of points, e.g. of circles around the joints of an arm, as an obstacle."""

from __future__ import annotations

from typing import Annotated

import coal
import numpy as np
import pinocchio as pin
import scipy
from numpy.typing import ArrayLike
from pydantic import Field

from ..arguments import Shape, checked
from ..arms.fit.triangles import convex
from ..errors import InputError
from .polytope import Polytope
from .quantities import array_of, frozen
from .vectors import perpendicular

#: Vectors, one per circle.
Vectors = Annotated[ArrayLike, Shape("K", 3)]


@checked
class ConvexHull:
    """Smallest convex set that contains the points.

    Parameters
    ----------
    points : (M, 3)
        At least four, not all in one plane [m].

    Attributes
    ----------
    vertices : ndarray (V, 3)
        The extreme points.
    faces : ndarray (F, 3) of int
        Triangles of the surface, rows of ``vertices``.
    volume : float
        [m^3]
    polytope : Polytope
        What the distance kernels read.

    Raises
    ------
    InputError
        Too few or coplanar points, a wrong shape, NaN or infinity.
    """

    def __init__(self, points: ArrayLike) -> None:
        expected = "at least four finite points (M, 3) that do not lie in one plane"
        points = array_of("ConvexHull", "points", points, (None, 3), expected)
        try:
            hull = scipy.spatial.ConvexHull(points)
        except (ValueError, scipy.spatial.QhullError):
            raise InputError("ConvexHull", "points", points, expected) from None
        self.vertices = frozen(points[hull.vertices])
        number = np.zeros(len(points), dtype=int)
        number[hull.vertices] = np.arange(len(hull.vertices))
        self.faces = frozen(number[hull.simplices])
        self.volume = float(hull.volume)
        # Triangle f meets its neighbour k in the edge opposite to its corner k.
        one, corner = np.nonzero(hull.neighbors > np.arange(len(self.faces))[:, None])
        other = hull.neighbors[one, corner]
        ends = [self.faces[one, (corner + step) % 3] for step in (1, 2)]
        normals = hull.equations[:, :3]
        self.polytope = Polytope(
            self.vertices,
            hull.equations,
            self.faces,
            np.column_stack(ends),
            np.stack([normals[one], normals[other]], axis=1),
        )

    @checked
    def moved(self, placement: pin.SE3) -> ConvexHull:
        """The shape after a rigid motion."""
        return ConvexHull(self.vertices @ placement.rotation.T + placement.translation)

    def coal(self) -> tuple[coal.Convex, coal.Transform3s]:
        """Geometry and placement for coal."""
        return convex(self.vertices), coal.Transform3s()


@checked
def circle_points(
    centers: Vectors,
    axes: Vectors,
    radii: Annotated[ArrayLike, Shape("K")],
    count: Annotated[int, Field(ge=3, le=100_000)],
) -> np.ndarray:
    """c_k + r_k (cos(2 pi i / count) x_k + sin(2 pi i / count) y_k), x_k and y_k normal to axis k.

    Parameters
    ----------
    centers, axes : (K, 3)
        Centers [m] and directions normal to the planes of the circles.
    radii : (K,)
        [m]
    count : int
        Points per circle, at least 3.

    Returns
    -------
    ndarray (K count, 3)
    """
    angle = 2 * np.pi * np.arange(count) / count
    axes = np.asarray(axes, dtype=float)
    if not (np.abs(axes).max(axis=1, initial=0.0) > 0.0).all():
        raise InputError("circle_points", "axes", axes, "directions that are not zero")
    x = np.array([perpendicular(axis) for axis in axes])
    y = np.cross(axes, x) / np.linalg.norm(axes, axis=1, keepdims=True)
    ring = np.cos(angle)[:, None] * x[:, None] + np.sin(angle)[:, None] * y[:, None]
    points = np.asarray(centers)[:, None] + np.asarray(radii)[:, None, None] * ring
    return points.reshape(-1, 3)
