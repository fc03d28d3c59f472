"""An arm on its path as a moving convex obstacle: the hull of circles at its joint origins."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy

from ...arms import Arm
from ...errors import InputError
from ...kernel import kernel
from ...scene.bodies import PlacedArm
from ...scene.hull import circle_points
from ...scene.vectors import along, dot, minus, out_of_frame, scaled, vector
from .control_points import frames_of
from .gift_wrapping import MOST, wrap_hulls

FAR = np.inf
_LARGEST = 1e9  # [m] of a coordinate
#: Of a face whose plane is at most so far above a point [m], round-off may decide on which side of
#: it the point lies.
_LEVEL = 1e-9


class HullTrack(NamedTuple):
    """Hulls at T rows: outward planes n . x + c <= 0 (T, F, 4), corners of the faces (T, F, 3, 3).

    Rows with fewer faces repeat their last one. Without any row nothing is in the way.
    """

    planes: np.ndarray
    triangles: np.ndarray


class JointCircles(NamedTuple):
    """Circles at joint origins: frame numbers 1 ... nq + 1 (the flange) (C,), radii (C,) [m],
    points per circle, and whether their planes contain the joint axis instead of being normal to
    it."""

    frames: tuple[int, ...]
    radii: tuple[float, ...]
    per_circle: int
    containing_axis: bool = False


NO_HULL = HullTrack(np.empty((0, 0, 4)), np.empty((0, 0, 3, 3)))


def circles_on(placed: PlacedArm, circles: JointCircles, q: np.ndarray) -> np.ndarray:
    """Points of the circles in the world for configurations (N, nq), (N, C count, 3) [m].

    The circle at the flange lies normal to the last axis. Of a planar arm all circles lie in one
    plane; the poles c + r z and c - r z of each are added, so that the points span a volume.
    """
    arm, number = placed.arm, np.array(circles.frames)
    carrier = np.minimum(number, arm.nq)
    at_flange = number[:, np.newaxis] > arm.nq
    centres = np.where(at_flange, arm.chain.translation[-1], 0.0)
    axes = np.eye(3)[[0 if circles.containing_axis else 2] * len(number)]
    local = circle_points(centres, axes, circles.radii, circles.per_circle)
    carrier = np.repeat(carrier, circles.per_circle)
    if not circles.containing_axis and _planar(arm):
        poles = np.multiply.outer(circles.radii, [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
        local = np.vstack([local, (centres[:, np.newaxis] + poles).reshape(-1, 3)])
        carrier = np.append(carrier, np.repeat(np.minimum(number, arm.nq), 2))
    points = np.empty((len(q), len(local), 3))
    _carry(frames_of(placed, q), carrier, local, points)
    return points


@kernel
def _carry(frames, carrier, local, points):
    """Points (P, 3) of the frames (N, J, 3, 4) that carry them into ``points`` (N, P, 3)."""
    for n in range(len(frames)):
        for k in range(len(carrier)):
            at = out_of_frame(frames[n, carrier[k]], vector(local[k]))
            points[n, k, 0], points[n, k, 1], points[n, k, 2] = at


def _planar(arm: Arm) -> bool:
    """Whether all joints turn about parallel axes and their origins and the flange lie in one
    plane."""
    chain = arm.chain
    parallel = np.abs(np.abs(chain.rotation[1:-1, 2, 2]) - 1.0) < 1e-9
    level = np.abs(chain.translation[1:, 2]) < 1e-9
    return bool(parallel.all() and level.all())


def hull_track(points: np.ndarray) -> HullTrack:
    """Convex hulls of point sets (T, M, 3).

    Raises
    ------
    InputError
        Points that do not span a volume, or are no finite numbers.
    """
    points = np.ascontiguousarray(points, dtype=float)
    if points.ndim != 3 or points.shape[2] != 3 or points.shape[1] < 4:
        expected = "sets of at least four points (T, M, 3)"
        raise InputError("hull_track", "points", points.shape, expected)
    if not (np.abs(points) <= _LARGEST).all():  # which NaN is not
        expected = f"finite numbers of at most {_LARGEST:g} m"
        raise InputError("hull_track", "points", points, expected)
    rows, count = points.shape[:2]
    planes, triangles = np.empty((rows, 2 * count, 4)), np.empty((rows, 2 * count, 3, 3))
    faces = np.zeros(rows, dtype=np.int64)
    if count <= MOST:
        wrap_hulls(points, planes, triangles, faces)
    for k in np.flatnonzero(faces == 0):
        hull = _by_qhull(points[k])
        faces[k] = found = len(hull.simplices)
        planes[k, :found], triangles[k, :found] = hull.equations, points[k][hull.simplices]
    # A row with fewer faces repeats its last one.
    shown = np.minimum(np.arange(faces.max(initial=0)), faces[:, np.newaxis] - 1)
    row = np.arange(rows)[:, np.newaxis]
    return HullTrack(planes[row, shown], triangles[row, shown])


def _by_qhull(points: np.ndarray) -> scipy.spatial.ConvexHull:
    """The hull of points that are many, or lie so that round-off decides about a face."""
    try:
        return scipy.spatial.ConvexHull(points)
    except (ValueError, scipy.spatial.QhullError):
        expected = "at least four finite points that do not lie in one plane"
        raise InputError("hull_track", "points", points, expected) from None


def hull_distance(
    point: np.ndarray, planes: np.ndarray, triangles: np.ndarray
) -> tuple[float, np.ndarray]:
    """Signed distance of a point (3,) to a hull and its gradient; readable twin of
    :func:`point_hull`.

    Inside it is the height over the nearest plane, outside the distance to the nearest face, those
    included whose plane the point misses by round-off. On the surface the direction is the normal
    of the plane that it is highest above.
    """
    height = planes[:, :3] @ point + planes[:, 3]
    top = int(height.argmax())
    if height[top] <= 0.0:
        return float(height[top]), planes[top, :3].copy()
    faced = triangles[height > -_LEVEL]
    feet = np.array([_nearest_on_triangle(point, corners) for corners in faced])
    gaps = point - feet
    distance = np.linalg.norm(gaps, axis=1)
    best = int(distance.argmin())
    if distance[best] <= _LEVEL:
        return float(distance[best]), planes[top, :3].copy()
    return float(distance[best]), gaps[best] / distance[best]


@kernel
def point_hull(p, planes, triangles):
    """Signed distance of a point to a hull [m] and the direction in which it grows."""
    top, height = 0, -np.inf
    for f in range(len(planes)):
        above = dot(vector(planes[f]), p) + planes[f, 3]
        if above > height:
            top, height = f, above
    if height <= 0.0:
        return height, vector(planes[top])
    best, gap = np.inf, p
    for f in range(len(planes)):
        above = dot(vector(planes[f]), p) + planes[f, 3]
        if -_LEVEL < above < best:
            away = minus(p, on_triangle(p, triangles[f]))
            length = dot(away, away) ** 0.5
            if length < best:
                best, gap = length, away
    if best <= _LEVEL:  # of a gap that small nothing but noise is left of its direction
        return best, vector(planes[top])
    return best, scaled(1.0 / best, gap)


@kernel
def on_triangle(p, corners):
    """Nearest point of a triangle (3, 3), by the regions of its corners, edges and face.

    C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5.
    """
    a, b, c = vector(corners[0]), vector(corners[1]), vector(corners[2])
    ab, ac, ap = minus(b, a), minus(c, a), minus(p, a)
    d1, d2 = dot(ab, ap), dot(ac, ap)
    if d1 <= 0.0 and d2 <= 0.0:
        return a
    bp = minus(p, b)
    d3, d4 = dot(ab, bp), dot(ac, bp)
    if d3 >= 0.0 and d4 <= d3:
        return b
    cp = minus(p, c)
    d5, d6 = dot(ab, cp), dot(ac, cp)
    if d6 >= 0.0 and d5 <= d6:
        return c
    vc, vb, va = d1 * d4 - d3 * d2, d5 * d2 - d1 * d6, d3 * d6 - d5 * d4
    if vc <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        return along(a, d1 / (d1 - d3), ab)
    if vb <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        return along(a, d2 / (d2 - d6), ac)
    if va <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        return along(b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), minus(c, b))
    total = va + vb + vc
    return along(along(a, vb / total, ab), vc / total, ac)


def _nearest_on_triangle(p: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """The foot of the plumb line if it is inside, else the nearest point of the three edges."""
    a, b, c = corners
    normal = np.cross(b - a, c - a)
    weights = np.linalg.solve(np.column_stack([a - c, b - c, normal]), p - c)[:2]
    if weights.min() >= 0.0 and weights.sum() <= 1.0:
        return c + weights @ np.array([a - c, b - c])
    feet = []
    for start, end in ((a, b), (b, c), (c, a)):
        edge = end - start
        feet.append(start + np.clip((p - start) @ edge / (edge @ edge), 0.0, 1.0) * edge)
    return min(feet, key=lambda foot: float(np.linalg.norm(p - foot)))
