"""Signed distance of a segment to a convex polytope.

The polytope swept along -u is bounded by the planes of its faces and, where an edge lies between a
face turned towards u and one turned away, by the plane through that edge and u. The greatest height
S of the segment a + [0, 1] u above those planes decides: S <= 0 is minus the length of the shortest
translation that parts the two. Otherwise they are apart, and the nearest points are on an edge and
the segment or on a face and an end of the segment.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..kernel import kernel
from .segments import CORES_MEET, ROUNDING, clamped, closest_parameters, lowest
from .vectors import along, cross, dot, minus, scaled, vector


class Polytope(NamedTuple):
    """Vertices (V, 3), outward planes n . x + c <= 0 of the triangles (F, 4) with their corners
    (F, 3), edges (E, 2) and the outward normals (E, 2, 3) of the triangles that meet there."""

    vertices: np.ndarray
    planes: np.ndarray
    corners: np.ndarray
    edges: np.ndarray
    normals: np.ndarray


@kernel
def highest_plane(a, u, polytope):
    """Greatest height S of a + [0, 1] u above the planes, the normal, and the face or edge.

    Returns
    -------
    height, normal, face, edge
        The index that does not apply is -1.
    """
    height, normal, face, edge = -np.inf, (0.0, 0.0, 1.0), -1, -1
    for f in range(len(polytope.planes)):
        n = vector(polytope.planes[f])
        lower = dot(n, a) + min(dot(n, u), 0.0) + polytope.planes[f, 3]
        if lower > height:
            height, normal, face = lower, n, f
    for e in range(len(polytope.edges)):
        n1, n2 = vector(polytope.normals[e, 0]), vector(polytope.normals[e, 1])
        c1, c2 = dot(n1, u), dot(n2, u)
        if c1 * c2 < 0.0:
            # A positive combination supports the polytope at the edge however short it is, so that
            # rounding cannot pretend a gap; edge x u is noise where the two are parallel.
            m = along(scaled(abs(c2), n1), abs(c1), n2)
            m = scaled(1.0 / dot(m, m) ** 0.5, m)
            b = vector(polytope.vertices[polytope.edges[e, 0]])
            lower = dot(m, minus(a, b)) + min(dot(m, u), 0.0)
            if lower > height + (ROUNDING if edge < 0 else 0.0):
                height, normal, face, edge = lower, m, -1, e
    return height, normal, face, edge


@kernel
def nearest_points(a, u, polytope):
    """Nearest points of a segment and a polytope that are apart."""
    distance, p, q = np.inf, a, a
    for e in range(len(polytope.edges)):
        b = vector(polytope.vertices[polytope.edges[e, 0]])
        v = minus(vector(polytope.vertices[polytope.edges[e, 1]]), b)
        s, t = closest_parameters(a, u, b, v)
        on_segment, on_edge = along(a, s, u), along(b, t, v)
        gap = minus(on_edge, on_segment)
        if dot(gap, gap) < distance * distance:
            distance, p, q = dot(gap, gap) ** 0.5, on_segment, on_edge
    for f in range(len(polytope.planes)):
        n = vector(polytope.planes[f])
        for k in range(2):
            end = along(a, float(k), u)
            height = dot(n, end) + polytope.planes[f, 3]
            if -ROUNDING < height < distance:
                foot = along(end, -height, n)
                if in_triangle(foot, n, polytope.corners[f], polytope.vertices):
                    distance, p, q = abs(height), end, foot
    return p, q


@kernel
def in_triangle(p, n, corners, vertices):
    """Whether a point of the plane of a triangle is on the same side of its three edges."""
    left = right = True
    for k in range(3):
        start = vector(vertices[corners[k]])
        side = minus(vector(vertices[corners[(k + 1) % 3]]), start)
        turn = dot(n, cross(side, minus(p, start)))
        left, right = left and turn >= 0.0, right and turn <= 0.0
    return left or right


@kernel
def deepest_parameter(a, u, polytope, height, normal, face, edge):
    """Parameter of the point of a + [0, 1] u that touches the polytope last on its way out."""
    if edge >= 0:
        b = vector(polytope.vertices[polytope.edges[edge, 0]])
        v = minus(vector(polytope.vertices[polytope.edges[edge, 1]]), b)
        return closest_parameters(along(a, -height, normal), u, b, v)[0]
    low, high = 0.0, 1.0  # the part that leaves through this face
    out = along(a, -height, normal)
    for f in range(len(polytope.planes)):
        n = vector(polytope.planes[f])
        slope = dot(n, u)
        if f != face and abs(slope) > CORES_MEET:
            t = clamped(-(dot(n, out) + polytope.planes[f, 3]) / slope, 0.0, 1.0)
            if slope > 0.0:
                high = min(high, t)
            else:
                low = max(low, t)
    return lowest(low, high, dot(normal, u))


@kernel
def segment_polytope(a, u, polytope):
    """Signed distance of a + [0, 1] u, nearest points, unit normal segment to polytope.

    In penetration the points are the deepest point of the segment and where the shortest exit takes
    it.

    Returns
    -------
    distance, point_segment, point_polytope, normal
    """
    height, outward, face, edge = highest_plane(a, u, polytope)
    if height > 0.0:
        p, q = nearest_points(a, u, polytope)
        gap = minus(q, p)
        distance = dot(gap, gap) ** 0.5
        if distance > CORES_MEET:
            return distance, p, q, scaled(1.0 / distance, gap)
    p = along(a, deepest_parameter(a, u, polytope, height, outward, face, edge), u)
    return height, p, along(p, -height, outward), scaled(-1.0, outward)
