"""Convex hulls of many small point sets by gift wrapping, a whole face with all corners at once.

From an open edge of a face the plane turns about the edge until it meets a point. All points in the
plane form the next face, so that points of one circle, or of parallel circles, make one polygon and
not a heap of slivers. D. R. Chand, S. S. Kapur, An algorithm for convex polytopes, Journal of the
ACM 17, 1970.
"""

from __future__ import annotations

import numpy as np

from ...kernel import kernel
from ...scene.vectors import cross, dot, minus, scaled, vector

#: Points of one set: the memory of the edges grows with their square.
MOST = 256
#: Distance to a plane, or to another point, that is none, as a share of the extent of the points.
_LEVEL = 1e-12
_THIN = 100.0  # times as much is the least height of a volume
_TRIES = 8  # for the point that a turning plane meets first


@kernel
def wrap_hulls(points, planes, triangles, counts):
    """Hulls of the sets ``points`` (T, M, 3): triangles (T, 2 M, 3, 3) with corners in positive
    order seen from outside, their outward planes n . x + c <= 0 (T, 2 M, 4), and their number
    (T,), 0 where the points do not span a volume or lie so that round-off decides."""
    most = points.shape[1]
    x, y, z, keys = np.empty(most), np.empty(most), np.empty(most), np.empty(most)
    owner = np.empty((most, most), np.int64)
    for i in range(most * most):
        owner[i // most, i % most] = -1
    ring, open_edges = np.empty(most, np.int64), np.empty((6 * most, 2), np.int64)
    normals = np.empty((len(open_edges), 3))
    for t in range(len(points)):
        count, level = _distinct(points[t], x, y, z)
        counts[t] = 0
        if count >= 4:
            xyz = x[:count], y[:count], z[:count]
            work = keys, owner, ring, open_edges, normals
            counts[t] = _wrapped(t, xyz, level, work, planes[t], triangles[t])


@kernel
def _distinct(points, x, y, z):
    """The points without repeats into ``x``, ``y``, ``z``; their number, and the distance that is
    none."""
    extent = 0.0
    for r in range(3):
        low = high = points[0, r]
        for i in range(1, len(points)):
            low, high = min(low, points[i, r]), max(high, points[i, r])
        extent = max(extent, high - low)
    level, count = _LEVEL * extent, 0
    for i in range(len(points)):
        a, b, c = points[i, 0], points[i, 1], points[i, 2]
        new = True
        for k in range(count):
            if abs(x[k] - a) <= level and abs(y[k] - b) <= level and abs(z[k] - c) <= level:
                new = False
                break
        if new:
            x[count], y[count], z[count] = a, b, c
            count += 1
    return count, level


@kernel
def _wrapped(t, xyz, level, work, planes, triangles):
    """Faces of hull number ``t``; how many, 0 if the surface does not close."""
    keys, owner, ring, edges, normals = work
    first = 0
    for i in range(1, len(xyz[0])):
        if xyz[0][i] < xyz[0][first]:
            first = i
    a = _point(xyz, first)
    up, left = (0.0, 0.0, 1.0), (-1.0, 0.0, 0.0)
    normal, size = _turned(xyz, a, up, left, level, keys, ring)
    if size < 2:
        return 0
    _swap(ring, size, _farthest(xyz, ring, size), 0)
    corners = _ordered(xyz, normal, 1, level, ring, size)
    if corners == 2:  # a line: the plane turns once more about it
        i, j = ring[0], ring[1]
        normal, size = _about(xyz, i, j, normal, level, keys, ring)
        corners = _next(xyz, normal, j, i, level, ring, size)
    if corners < 3 or not _spans(xyz, normal, ring[0], level):
        return 0
    faces = waiting = 0
    while corners > 2:
        if faces + corners > len(planes) or waiting + corners > len(edges):
            return 0
        if corners > 3:
            normal = _of_polygon(xyz, ring, corners)
        for k in range(corners):
            i, j = ring[k], ring[(k + 1) % corners]
            if owner[i, j] == t:
                return 0
            owner[i, j] = t
            if owner[j, i] != t:
                edges[waiting, 0], edges[waiting, 1] = i, j
                normals[waiting, 0], normals[waiting, 1], normals[waiting, 2] = normal
                waiting += 1
        offset = -np.inf
        for k in range(corners):
            offset = max(offset, dot(normal, _point(xyz, ring[k])))
        for k in range(1, corners - 1):
            planes[faces, 0], planes[faces, 1], planes[faces, 2] = normal
            planes[faces, 3] = -offset
            for c, i in enumerate((ring[0], ring[k], ring[k + 1])):
                at = _point(xyz, i)
                triangles[faces, c, 0], triangles[faces, c, 1], triangles[faces, c, 2] = at
            faces += 1
        i = j = -1
        while waiting > 0:
            waiting -= 1
            i, j = edges[waiting, 0], edges[waiting, 1]
            if owner[j, i] != t:
                break
            i = -1
        if i < 0:
            return faces
        normal, size = _about(xyz, i, j, vector(normals[waiting]), level, keys, ring)
        corners = _next(xyz, normal, j, i, level, ring, size)
    return 0


@kernel
def _about(xyz, i, j, normal, level, keys, ring):
    """As :func:`_turned` about the edge from i to j."""
    a = _point(xyz, i)
    way = minus(_point(xyz, j), a)
    return _turned(xyz, a, scaled(1.0 / dot(way, way) ** 0.5, way), normal, level, keys, ring)


@kernel
def _turned(xyz, a, way, normal, level, keys, ring):
    """Normal of the plane about the line through ``a`` that leaves all points below, met first as a
    plane of that ``normal`` turns; the points in it into ``ring``, and how many (0: not found)."""
    x, y, z = xyz
    count = len(x)
    aside = cross(way, normal)
    for i in range(count):
        dx, dy, dz = x[i] - a[0], y[i] - a[1], z[i] - a[2]
        out = dx * aside[0] + dy * aside[1] + dz * aside[2]
        down = -(dx * normal[0] + dy * normal[1] + dz * normal[2])
        far = abs(out) + abs(down)
        keys[i] = out / far if far > 2.0 * level else -2.0
    best, largest = -1, -1.5
    for i in range(count):
        if keys[i] > largest:
            best, largest = i, keys[i]
    for _ in range(_TRIES):
        if best < 0:
            return normal, 0
        found = cross(minus(_point(xyz, best), a), way)
        length = dot(found, found) ** 0.5
        if not length > level:
            return normal, 0
        found = scaled(1.0 / length, found)
        offset = dot(found, a)
        for i in range(count):
            keys[i] = x[i] * found[0] + y[i] * found[1] + z[i] * found[2] - offset
        size, above, best = 0, level, -1
        for i in range(count):
            if keys[i] >= -level:
                ring[size] = i
                size += 1
                if keys[i] > above:
                    above, best = keys[i], i
        if best < 0:
            return found, size
    return normal, 0


@kernel
def _next(xyz, normal, first, second, level, ring, size):
    """As :func:`_ordered` of a face whose edge from ``first`` to ``second`` is known."""
    if size < 3:
        return 0
    _swap(ring, size, first, 0)
    _swap(ring, size, second, 1)
    if size > 3:
        return _ordered(xyz, normal, 2, level, ring, size)
    a, b = _point(xyz, first), _point(xyz, second)
    way = minus(b, a)
    over = dot(cross(way, minus(_point(xyz, ring[2]), a)), normal)
    return 3 if over > level * dot(way, way) ** 0.5 else 0


@kernel
def _ordered(xyz, normal, corners, level, ring, size):
    """Put the corners of the convex polygon of ``size`` points in a plane first in ``ring``, in
    positive order, of which the first one or two are known; how many, 0 if it does not close."""
    while corners <= size:
        here = _point(xyz, ring[corners - 1])
        best, way, length = -1, here, 0.0
        for k in range(size):
            if 0 < k < corners or k == corners - 1:
                continue
            to = minus(_point(xyz, ring[k]), here)
            over, far = dot(cross(way, to), normal), dot(to, to) ** 0.5
            if best < 0 or over < -level * length or (over <= level * length and far > length):
                best, way, length = k, to, far
        if best == 0:
            return corners
        if best < 0 or corners == size:
            return 0
        ring[corners], ring[best] = ring[best], ring[corners]
        corners += 1
    return 0


@kernel
def _swap(ring, size, wanted, place):
    for k in range(size):
        if ring[k] == wanted:
            ring[k], ring[place] = ring[place], ring[k]
            return


@kernel
def _farthest(xyz, ring, size):
    """The point of a ring farthest from its first: a corner of any polygon of them."""
    a, end, longest = _point(xyz, ring[0]), ring[0], -1.0
    for k in range(size):
        way = minus(_point(xyz, ring[k]), a)
        if dot(way, way) > longest:
            longest, end = dot(way, way), ring[k]
    return end


@kernel
def _spans(xyz, normal, corner, level):
    """Whether some point lies below the plane of a face."""
    a = _point(xyz, corner)
    for i in range(len(xyz[0])):
        if dot(normal, minus(_point(xyz, i), a)) < -_THIN * level:
            return True
    return False


@kernel
def _of_polygon(xyz, ring, corners):
    """Unit normal of a polygon: the sum of its triangles, after Newell."""
    a = _point(xyz, ring[0])
    x = y = z = 0.0
    for k in range(1, corners - 1):
        part = cross(minus(_point(xyz, ring[k]), a), minus(_point(xyz, ring[k + 1]), a))
        x, y, z = x + part[0], y + part[1], z + part[2]
    return scaled(1.0 / (x * x + y * y + z * z) ** 0.5, (x, y, z))


@kernel
def _point(xyz, i):
    return xyz[0][i], xyz[1][i], xyz[2][i]
