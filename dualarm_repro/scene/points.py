"""Signed distance of control points to obstacles and its gradient, for potential-field planners.

grad d is the unit outward normal of the obstacle at the foot of the point; it is continuous outside
a convex shape. The smallest of several distances has creases, so a shape is one column: planners
choose whether to sum over the bars of a window or to take the nearest.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from ..annotation import real_array
from ..arguments import LATER, checked
from ..errors import InputError
from ..kernel import kernel
from .boxes import excess, shortest_exit
from .hull import ConvexHull
from .polytope import segment_polytope
from .segments import CORES_MEET, projected
from .shapes import Box, Capsule, HalfSpace, Shape, Sphere, not_a_shape
from .vectors import along, dot, into_frame, minus, perpendicular, rotated, scaled, vector


@kernel
def point_capsule(p, a, u, radius):
    """d = |p - a - s u| - r, s the projection to the core; on the core, one of its normals."""
    gap = minus(p, along(a, projected(p, a, u, dot(u, u)), u))
    distance = dot(gap, gap) ** 0.5
    normal = scaled(1.0 / distance, gap) if distance > CORES_MEET else perpendicular(u)
    return distance - radius, normal


@kernel
def point_box(p, pose, h):
    """d = |e| with the excess e outside, minus the depth below the nearest face inside."""
    p = into_frame(pose, p)
    e = excess(p, h)
    distance = dot(e, e) ** 0.5
    if distance > CORES_MEET:
        return distance, rotated(pose, scaled(1.0 / distance, e))
    depth, direction, _ = shortest_exit(p, (0.0, 0.0, 0.0), h)
    return -depth, rotated(pose, direction)


@kernel
def to_capsule(points, core, radius, distance, gradient):
    """:func:`point_capsule` for the rows of ``points`` (K, 3)."""
    a = vector(core[0])
    u = minus(vector(core[1]), a)
    for k in range(len(points)):
        distance[k], normal = point_capsule(vector(points[k]), a, u, radius)
        gradient[k, 0], gradient[k, 1], gradient[k, 2] = normal


@kernel
def to_box(points, pose, half, distance, gradient):
    """:func:`point_box` for the rows of ``points`` (K, 3)."""
    h = vector(half)
    for k in range(len(points)):
        distance[k], normal = point_box(vector(points[k]), pose, h)
        gradient[k, 0], gradient[k, 1], gradient[k, 2] = normal


@kernel
def to_hull(points, polytope, distance, gradient):
    """Signed distances to a convex polytope for the rows of ``points`` (K, 3)."""
    for k in range(len(points)):
        p = vector(points[k])
        distance[k], _, _, inward = segment_polytope(p, (0.0, 0.0, 0.0), polytope)
        gradient[k, 0], gradient[k, 1], gradient[k, 2] = scaled(-1.0, inward)


@checked
def point_distances(
    points: ArrayLike, shapes: Annotated[Sequence[Shape], LATER]
) -> tuple[np.ndarray, np.ndarray]:
    """d_m(p) and its gradient for every point and shape.

    Parameters
    ----------
    points : (..., 3)
        World coordinates [m].
    shapes : sequence of M shapes

    Returns
    -------
    distance : ndarray (..., M)
        Signed, negative inside [m].
    gradient : ndarray (..., M, 3)
        Unit vectors. On the center of a sphere or the core of a capsule, and where several faces of
        a box are equally near from inside, one of the possible directions.

    Raises
    ------
    InputError
        ``points`` has another shape, NaN or infinity.
    """
    try:
        points = real_array(points)
    except (TypeError, ValueError):
        raise InputError(
            "point_distances", "points", points, "finite coordinates (..., 3)"
        ) from None
    if points.ndim < 1 or points.shape[-1] != 3 or not np.isfinite(points).all():
        raise InputError("point_distances", "points", points, "finite coordinates (..., 3)")
    rows = np.ascontiguousarray(points.reshape(-1, 3))
    if not isinstance(shapes, Sequence):
        raise InputError("point_distances", "shapes", shapes, "a sequence of shapes")
    distance = np.empty((len(shapes), len(rows)))
    gradient = np.empty((len(shapes), len(rows), 3))
    for shape, d, g in zip(shapes, distance, gradient, strict=True):
        match shape:
            case Box():
                to_box(rows, shape.pose, shape.half, d, g)
            case HalfSpace():
                d[:], g[:] = rows @ shape.normal - shape.offset, shape.normal
            case ConvexHull():
                to_hull(rows, shape.polytope, d, g)
            case Sphere() | Capsule():
                to_capsule(rows, shape.core, shape.radius, d, g)
            case _:
                raise not_a_shape("point_distances", shape)
    leading = points.shape[:-1]
    return (
        np.moveaxis(distance, 0, -1).reshape(*leading, len(shapes)),
        np.moveaxis(gradient, 0, 1).reshape(*leading, len(shapes), 3),
    )
