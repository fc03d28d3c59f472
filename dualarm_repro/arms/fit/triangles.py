"""Surfaces of shapes as triangles."""

from __future__ import annotations

import math

import coal
import numpy as np
import scipy

from ..capsules import corners

_SIDES = 24  # of the prism around a cylinder
PRISM = 1.0 / math.cos(math.pi / _SIDES)  # its circumradius over the radius of the cylinder


def triangles_of(solid: coal.CollisionGeometry) -> np.ndarray:
    """The surface of a box or mesh, or of a prism that just contains a cylinder (T, 3, 3) [m].

    Raises
    ------
    UnsupportedArmError
        The shape is none of these.
    """
    if isinstance(solid, coal.Cylinder):
        turn = 2.0 * math.pi * np.arange(_SIDES) / _SIDES
        radius = solid.radius * PRISM
        rim = radius * np.column_stack([np.cos(turn), np.sin(turn)])
        ends = (np.full(_SIDES, sign * solid.halfLength) for sign in (-1.0, 1.0))
        return _hull(np.vstack([np.column_stack([rim, z]) for z in ends]))
    points = corners(solid)
    if not isinstance(solid, coal.BVHModelBase):
        return _hull(points)
    rows = [solid.tri_indices(k) for k in range(solid.num_tris)]
    if not rows:  # points without a surface: each a triangle of no extent
        return np.repeat(points[:, np.newaxis], 3, axis=1)
    indices = np.array([(row[0], row[1], row[2]) for row in rows])
    found: np.ndarray = points[indices]
    return found


def surface_of(triangles: np.ndarray) -> coal.BVHModelOBBRSS:
    """A mesh of triangles (T, 3, 3), as coal reads it."""
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(triangles), 3 * len(triangles))
    for a, b, c in triangles:
        mesh.addTriangle(a, b, c)
    mesh.endModel()
    return mesh


def convex(corners: np.ndarray) -> coal.Convex:
    """The convex hull of its corners (V, 3), as coal reads it.

    The faces are Qhull's by way of scipy: coal's own call of it ends the process on thin bodies.
    """
    try:
        hull = scipy.spatial.ConvexHull(corners)
    except scipy.spatial.QhullError:  # thin, and turned
        hull = scipy.spatial.ConvexHull(corners, qhull_options="QJ")
    number = np.zeros(len(corners), dtype=int)
    number[hull.vertices] = np.arange(len(hull.vertices))
    points, faces = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    points.extend(list(corners[hull.vertices]))
    faces.extend([coal.Triangle(a, b, c) for a, b, c in number[hull.simplices].tolist()])
    return coal.Convex(points, faces)


def _hull(points: np.ndarray) -> np.ndarray:
    """Triangles of the convex hull of points that span a body."""
    found: np.ndarray = points[scipy.spatial.ConvexHull(points).simplices]
    return found
