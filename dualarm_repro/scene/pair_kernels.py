"""Signed distances of many capsules to other bodies, for many configurations.

Row n of every array is one configuration; ``pairs`` (K, 2) names rows of the two sorts of bodies.
Each kernel fills K columns, from ``column`` on, of ``distance`` (N, P) and, unless it is empty, of
``witness`` (N, P, 3, 3) with the points on a and b and the unit normal from a to b, such that
point_b = point_a + distance * normal. (A slice of columns would be an array of another layout,
for which everything is compiled once more.)
Inflating both cores by their radii moves the points along the normal and shortens the distance by
the radii, also for cores that overlap.
"""

from __future__ import annotations

from ..kernel import kernel
from .boxes import segment_box, segment_box_distance
from .lane_distances import LANES, capsule_lanes
from .polytope import segment_polytope
from .segments import closest_parameters, segment_segment
from .vectors import along, dot, into_frame, minus, out_of_frame, rotated, scaled, vector


@kernel
def _write(witness, p, q, normal):
    for k in range(3):
        witness[0, k] = p[k]
        witness[1, k] = q[k]
        witness[2, k] = normal[k]


@kernel
def capsules_capsules(ends, radius, pairs, distance, witness, column):
    """d = |core distance| - r_a - r_b; ``ends`` (N, C, 2, 3), ``radius`` (C,)."""
    blocks = 0 if witness.size else len(distance) // LANES * LANES
    if blocks:
        capsule_lanes(ends, radius, pairs, distance[:blocks], column)
    for n in range(blocks, len(distance)):
        for k in range(len(pairs)):
            i, j = pairs[k]
            a, b = vector(ends[n, i, 0]), vector(ends[n, j, 0])
            u, v = minus(vector(ends[n, i, 1]), a), minus(vector(ends[n, j, 1]), b)
            if witness.size:
                gap, p, q, normal = segment_segment(a, u, b, v)
                p, q = along(p, radius[i], normal), along(q, -radius[j], normal)
                _write(witness[n, column + k], p, q, normal)
            else:
                s, t = closest_parameters(a, u, b, v)
                difference = minus(along(b, t, v), along(a, s, u))
                gap = dot(difference, difference) ** 0.5
            distance[n, column + k] = gap - radius[i] - radius[j]


@kernel
def capsules_boxes(ends, radius, poses, half, pairs, distance, witness, column):
    """d = signed core distance - r; ``poses`` (N, B, 3, 4) and half edges ``half`` (B, 3)."""
    for n in range(len(distance)):
        for k in range(len(pairs)):
            i, j = pairs[k]
            pose, h = poses[n, j], vector(half[j])
            a = into_frame(pose, vector(ends[n, i, 0]))
            u = minus(into_frame(pose, vector(ends[n, i, 1])), a)
            if witness.size:
                gap, p, q, normal = segment_box(a, u, h)
                p = along(p, radius[i], normal)
                p, q, normal = out_of_frame(pose, p), out_of_frame(pose, q), rotated(pose, normal)
                _write(witness[n, column + k], p, q, normal)
            else:
                gap = segment_box_distance(a, u, h)
            distance[n, column + k] = gap - radius[i]


@kernel
def capsules_hull(ends, radius, poses, polytope, hull, pairs, distance, witness, column):
    """d = signed core distance - r; fills the pairs with one hull, row ``hull`` of ``poses``."""
    for n in range(len(distance)):
        for k in range(len(pairs)):
            i, j = pairs[k]
            if j != hull:
                continue
            pose = poses[n, j]
            a = into_frame(pose, vector(ends[n, i, 0]))
            u = minus(into_frame(pose, vector(ends[n, i, 1])), a)
            gap, p, q, normal = segment_polytope(a, u, polytope)
            distance[n, column + k] = gap - radius[i]
            if witness.size:
                p = along(p, radius[i], normal)
                p, q, normal = out_of_frame(pose, p), out_of_frame(pose, q), rotated(pose, normal)
                _write(witness[n, column + k], p, q, normal)


@kernel
def capsules_planes(ends, radius, planes, pairs, distance, witness, column):
    """d = min(n . a, n . b) - offset - r; ``planes`` (H, 4) rows of normal and offset.

    Of a core parallel to the plane the middle is the witness.
    """
    for n in range(len(distance)):
        for k in range(len(pairs)):
            i, j = pairs[k]
            up = vector(planes[j])
            a = vector(ends[n, i, 0])
            u = minus(vector(ends[n, i, 1]), a)
            climb = dot(up, u)
            p = along(a, 1.0 if climb < 0.0 else 0.0 if climb > 0.0 else 0.5, u)
            distance[n, column + k] = dot(up, p) - planes[j, 3] - radius[i]
            if witness.size:
                p = along(p, -radius[i], up)
                q = along(p, -distance[n, column + k], up)
                _write(witness[n, column + k], p, q, scaled(-1.0, up))
