"""Which of a block of configurations leave a pair uncertain, by squared distances in SIMD lanes.

A capsule of an arm is its middle m and half core v, three numbers each for every lane, one after
the other: d = |m_b - m_a + t v_b - s v_a| - r_a - r_b at the best s, t in [-1, 1]. Loops only read
and gather bits: lane k of the answer is set where d <= margin + way * half, and the answer is
negative where d <= margin. ``apart`` is the sum of the radii and the margin [m], ``extent`` half
the length of the core, ``way`` the relative way over the edge [m]. Comparisons ask what is farther,
so that NaN counts as a contact.
"""

from __future__ import annotations

import numpy as np

from ..kernel import inlined, kernel
from .boxes import segment_box_distance
from .polytope import Polytope, segment_polytope
from .segments import PARALLEL
from .vectors import into_frame, rotated_back, vector

LANES = 16
_X, _Y, _Z, _U, _V, _W, _SQUARE = (k * LANES for k in range(7))


@kernel
def far_apart(a, b, apart, way, halves):
    """Whether the spheres around two capsules, ``apart`` when they touch, leave nothing unsure."""
    near = 0
    for k in range(LANES):
        x, y, z = b[_X + k] - a[_X + k], b[_Y + k] - a[_Y + k], b[_Z + k] - a[_Z + k]
        need = apart + way * halves[k]
        near |= 0 if x * x + y * y + z * z > need * need else 1
    return near == 0


@kernel
def near_point(a, p, apart, way, halves):
    """Bits of the lanes whose sphere around the capsule is not far enough from a point."""
    near = 0
    for k in range(LANES):
        x, y, z = p[0] - a[_X + k], p[1] - a[_Y + k], p[2] - a[_Z + k]
        need = apart + way * halves[k]
        near |= (0 if x * x + y * y + z * z > need * need else 1) << k
    return near


@kernel
def near_box(a, pose, half, apart, way, halves):
    """Bits of the lanes whose sphere around the capsule is not far enough from a box."""
    near = 0
    p0, p1, p2, h0, h1, h2 = pose[0, 3], pose[1, 3], pose[2, 3], half[0], half[1], half[2]
    r00, r10, r20 = pose[0, 0], pose[1, 0], pose[2, 0]
    r01, r11, r21 = pose[0, 1], pose[1, 1], pose[2, 1]
    r02, r12, r22 = pose[0, 2], pose[1, 2], pose[2, 2]
    for k in range(LANES):
        x, y, z = a[_X + k] - p0, a[_Y + k] - p1, a[_Z + k] - p2
        e = max(abs(r00 * x + r10 * y + r20 * z) - h0, 0.0)
        f = max(abs(r01 * x + r11 * y + r21 * z) - h1, 0.0)
        g = max(abs(r02 * x + r12 * y + r22 * z) - h2, 0.0)
        need = apart + way * halves[k]
        near |= (0 if e * e + f * f + g * g > need * need else 1) << k
    return near


@kernel
def solid_of(hulls, row):
    """One of the convex hulls that are kept in rows of one array."""
    first, last = hulls.first[row], hulls.first[row + 1]
    return Polytope(
        hulls.solids.vertices[first[0] : last[0]],
        hulls.solids.planes[first[1] : last[1]],
        hulls.solids.corners[first[1] : last[1]],
        hulls.solids.edges[first[2] : last[2]],
        hulls.solids.normals[first[2] : last[2]],
    )


@inlined
def clamped(s):
    """s, within [-1, 1]."""
    return min(max(s, -1.0), 1.0)


@inlined
def squared_gap(x, y, z, u, v, w, e, f, g, uu, vv):
    """Squared distance of the cores s (u, v, w) and (x, y, z) + t (e, f, g), s and t in [-1, 1],
    see :func:`.segments.closest_parameters`; ``uu``, ``vv``: squares of the half lengths."""
    iu = 1.0 / uu if uu > 0.0 else 0.0
    iv = 1.0 / vv if vv > 0.0 else 0.0
    cx, cy, cz = v * g - w * f, w * e - u * g, u * f - v * e
    cc = cx * cx + cy * cy + cz * cz
    dx, dy, dz = y * g - z * f, z * e - x * g, x * f - y * e
    skew = clamped((dx * cx + dy * cy + dz * cz) / cc)
    one = clamped(((x - e) * u + (y - f) * v + (z - g) * w) * iu)
    two = clamped(((x + e) * u + (y + f) * v + (z + g) * w) * iu)
    level = 0.5 * (one + two)
    s = skew if cc > PARALLEL * uu * vv else level
    t = clamped(((s * u - x) * e + (s * v - y) * f + (s * w - z) * g) * iv)
    s = clamped(((x + t * e) * u + (y + t * f) * v + (z + t * g) * w) * iu)
    x, y, z = x + t * e - s * u, y + t * f - s * v, z + t * g - s * w
    return x * x + y * y + z * z


@kernel
def capsule_lanes(ends, radius, pairs, distance, column):
    """d = |core distance| - r_a - r_b of every pair (K, 2) for whole blocks of configurations,
    into the columns of ``distance`` (N, P) from ``column`` on; ``ends`` (N, C, 2, 3), ``radius``
    (C,)."""
    w, gaps = np.empty((ends.shape[1], 7 * LANES)), np.empty(LANES)
    for start in range(0, len(distance), LANES):
        for c in range(len(w)):
            _fill(ends[start : start + LANES, c], w[c])
        for n in range(len(pairs)):
            i, j = pairs[n]
            _gaps(w[i], w[j], gaps)
            for k in range(LANES):
                distance[start + k, column + n] = gaps[k] - radius[i] - radius[j]


@kernel
def _fill(ends, out):
    """Middles, half cores and their squared lengths of one capsule (LANES, 2, 3)."""
    for k in range(LANES):
        square = 0.0
        for r in range(3):
            first, last = ends[k, 0, r], ends[k, 1, r]
            half = 0.5 * (last - first)
            out[r * LANES + k] = first + half
            out[(3 + r) * LANES + k] = half
            square += half * half
        out[_SQUARE + k] = square


@kernel
def _gaps(a, b, out):
    """Distances of the cores of two capsules."""
    for k in range(LANES):
        square = squared_gap(
            b[_X + k] - a[_X + k],
            b[_Y + k] - a[_Y + k],
            b[_Z + k] - a[_Z + k],
            a[_U + k],
            a[_V + k],
            a[_W + k],
            b[_U + k],
            b[_V + k],
            b[_W + k],
            a[_SQUARE + k],
            b[_SQUARE + k],
        )
        out[k] = square**0.5


@kernel
def unsure_capsules(a, b, extent_a, extent_b, apart, way, halves):
    """Two capsules that both move."""
    uu, vv = extent_a * extent_a, extent_b * extent_b
    hit, unsure, close = 0, 0, apart * apart
    for k in range(LANES):
        square = squared_gap(
            b[_X + k] - a[_X + k],
            b[_Y + k] - a[_Y + k],
            b[_Z + k] - a[_Z + k],
            a[_U + k],
            a[_V + k],
            a[_W + k],
            b[_U + k],
            b[_V + k],
            b[_W + k],
            uu,
            vv,
        )
        need = apart + way * halves[k]
        hit |= 0 if square > close else 1
        unsure |= (0 if square > need * need else 1) << k
    return -1 if hit else unsure


@kernel
def unsure_standing(a, b, extent, extent_b, apart, way, halves):
    """A capsule and one that stands, ``b`` (6,): its middle and half core."""
    p0, p1, p2, e, f, g = b[0], b[1], b[2], b[3], b[4], b[5]
    uu, vv = extent * extent, extent_b * extent_b
    hit, unsure, close = 0, 0, apart * apart
    for k in range(LANES):
        x, y, z = p0 - a[_X + k], p1 - a[_Y + k], p2 - a[_Z + k]
        u, v, w = a[_U + k], a[_V + k], a[_W + k]
        square = squared_gap(x, y, z, u, v, w, e, f, g, uu, vv)
        need = apart + way * halves[k]
        hit |= 0 if square > close else 1
        unsure |= (0 if square > need * need else 1) << k
    return -1 if hit else unsure


@kernel
def unsure_ball(a, b, extent, apart, way, halves):
    """A capsule and a sphere that stands."""
    p0, p1, p2 = b[0], b[1], b[2]
    uu = extent * extent
    inverse = 1.0 / uu if uu > 0.0 else 0.0
    hit, unsure, close = 0, 0, apart * apart
    for k in range(LANES):
        x, y, z = p0 - a[_X + k], p1 - a[_Y + k], p2 - a[_Z + k]
        u, v, w = a[_U + k], a[_V + k], a[_W + k]
        s = clamped((x * u + y * v + z * w) * inverse)
        x, y, z = x - s * u, y - s * v, z - s * w
        square = x * x + y * y + z * z
        need = apart + way * halves[k]
        hit |= 0 if square > close else 1
        unsure |= (0 if square > need * need else 1) << k
    return -1 if hit else unsure


@kernel
def unsure_plane(a, plane, apart, way, halves):
    """A capsule and a half-space, n . x <= offset: d = n . m - |n . v| - offset - r."""
    n0, n1, n2, offset = plane[0], plane[1], plane[2], plane[3]
    hit, unsure = 0, 0
    for k in range(LANES):
        height = n0 * a[_X + k] + n1 * a[_Y + k] + n2 * a[_Z + k] - offset
        lean = n0 * a[_U + k] + n1 * a[_V + k] + n2 * a[_W + k]
        low = height - abs(lean) - apart
        hit |= 0 if low > 0.0 else 1
        unsure |= (0 if low > way * halves[k] else 1) << k
    return -1 if hit else unsure


@kernel
def unsure_box(a, pose, half, extent, apart, way, halves):
    """A capsule and a box: exactly where the sphere around the capsule does not tell."""
    near, unsure = near_box(a, pose, half, apart + extent, way, halves), 0
    if near == 0:
        return 0
    for k in range(LANES):
        if near >> k & 1:
            start, core = core_of(a, k)
            gap = segment_box_distance(
                into_frame(pose, start), rotated_back(pose, core), vector(half)
            )
            if not gap > apart:
                return -1
            unsure |= (0 if gap > apart + way * halves[k] else 1) << k
    return unsure


@kernel
def unsure_hull(a, hulls, row, extent, apart, way, halves):
    """A capsule and a convex hull: exactly where the spheres around both do not tell."""
    around = apart + extent + hulls.around[row, 3]
    near, unsure = near_point(a, hulls.around[row], around, way, halves), 0
    if near == 0:
        return 0
    polytope = solid_of(hulls, row)
    for k in range(LANES):
        if near >> k & 1:
            start, core = core_of(a, k)
            gap = segment_polytope(start, core, polytope)[0]
            if not gap > apart:
                return -1
            unsure |= (0 if gap > apart + way * halves[k] else 1) << k
    return unsure


@kernel
def core_of(a, k):
    """Start of a core and the vector to its end."""
    x, y, z, u, v, w = a[_X + k], a[_Y + k], a[_Z + k], a[_U + k], a[_V + k], a[_W + k]
    return (x - u, y - v, z - w), (2.0 * u, 2.0 * v, 2.0 * w)
