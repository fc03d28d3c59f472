"""Which of a block of configurations of different edges leave a pair uncertain, in SIMD lanes.

As :mod:`.lane_distances`, but each lane has a way of its own, and a contact is told of its lane
alone: the answer has bit k where d <= margin + ways[k], and bit LANES + k where d <= margin too.
A lane is answered from its own numbers only, whatever is in the others, so that the answer for an
edge does not hang on the edges beside it.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from ..kernel import inlined, kernel
from .boxes import segment_box_distance
from .lane_distances import (
    LANES,
    clamped,
    core_of,
    near_box,
    near_point,
    solid_of,
    squared_gap,
)
from .polytope import segment_polytope
from .vectors import into_frame, rotated_back, vector

_X, _Y, _Z, _U, _V, _W = (k * LANES for k in range(6))


def _lowest_bit(context: Any, bits: Any) -> Any:
    def built(_: Any, builder: Any, __: Any, parts: Any) -> Any:
        return builder.cttz(parts[0], ir.Constant(ir.IntType(1), 1))

    return types.int64(types.int64), built


#: Number of the lowest bit of an integer that is not 0.
_lowest: Any = intrinsic(_lowest_bit)


@inlined
def _verdict(square, apart, way):
    """Bits 0 and LANES of a lane from a squared distance."""
    need = apart + way
    contact = 0 if square > apart * apart else (1 << LANES)
    return (0 if square > need * need else 1) | contact


@kernel
def near_spheres(ends, a, b, apart, travel, from_a, from_b):
    """Bits of the lanes whose spheres around two capsules are not far enough from each other."""
    near = 0
    for k in range(LANES):
        x = ends[b, _X + k] - ends[a, _X + k]
        y = ends[b, _Y + k] - ends[a, _Y + k]
        z = ends[b, _Z + k] - ends[a, _Z + k]
        need = apart + (travel[a, from_a, k] + travel[b, from_b, k])
        near |= (0 if x * x + y * y + z * z > need * need else 1) << k
    return near


@kernel
def near_standing(ends, a, stands, b, apart, travel):
    """The same of a capsule and one that stands."""
    near = 0
    for k in range(LANES):
        x = stands[b, 0] - ends[a, _X + k]
        y = stands[b, 1] - ends[a, _Y + k]
        z = stands[b, 2] - ends[a, _Z + k]
        need = apart + travel[a, 0, k]
        near |= (0 if x * x + y * y + z * z > need * need else 1) << k
    return near


@kernel
def queue_capsules(
    queue, owner, count, near, ends, a, b, square_a, square_b, apart, travel, from_a, from_b
):
    """Put the lanes ``near`` of two capsules that move at the end of a queue (Q, 13, LANES) whose
    ``owner`` (Q, LANES) are the lanes; returns the new length."""
    while near:
        k, n, i = _lowest(near), count // LANES, count % LANES
        for r in range(3):
            queue[n, r, i] = ends[b, r * LANES + k] - ends[a, r * LANES + k]
            queue[n, 3 + r, i] = ends[a, (3 + r) * LANES + k]
            queue[n, 6 + r, i] = ends[b, (3 + r) * LANES + k]
        queue[n, 9, i], queue[n, 10, i] = square_a, square_b
        queue[n, 11, i], queue[n, 12, i] = apart, travel[a, from_a, k] + travel[b, from_b, k]
        owner[n, i] = k
        near, count = near & (near - 1), count + 1
    return count


@kernel
def queue_standing(
    queue, owner, count, near, ends, a, stands, b, square_a, square_b, apart, travel
):
    """The same for a capsule and one that stands, ``stands[b]``: its middle and half core."""
    while near:
        k, n, i = _lowest(near), count // LANES, count % LANES
        for r in range(3):
            queue[n, r, i] = stands[b, r] - ends[a, r * LANES + k]
            queue[n, 3 + r, i] = ends[a, (3 + r) * LANES + k]
            queue[n, 6 + r, i] = stands[b, 3 + r]
        queue[n, 9, i], queue[n, 10, i] = square_a, square_b
        queue[n, 11, i], queue[n, 12, i] = apart, travel[a, 0, k]
        owner[n, i] = k
        near, count = near & (near - 1), count + 1
    return count


@kernel
def queue_verdict(queue, owner, count):
    """Of the first ``count`` entries of a queue, into the bits of their lanes."""
    found = 0
    for i in range(count, -(-count // LANES) * LANES):
        owner[i // LANES, i % LANES] = 2 * LANES  # bits that are no lane's
    for n in range(-(-count // LANES)):
        found |= _row_verdict(queue, owner, n)
    return found


@kernel
def _row_verdict(queue, owner, n):
    found = 0
    for k in range(LANES):
        square = squared_gap(
            queue[n, 0, k],
            queue[n, 1, k],
            queue[n, 2, k],
            queue[n, 3, k],
            queue[n, 4, k],
            queue[n, 5, k],
            queue[n, 6, k],
            queue[n, 7, k],
            queue[n, 8, k],
            queue[n, 9, k],
            queue[n, 10, k],
        )
        found |= _verdict(square, queue[n, 11, k], queue[n, 12, k]) << owner[n, k]
    return found


@kernel
def ball_verdict(ends, a, stands, b, extent, apart, travel):
    """A capsule and a sphere that stands."""
    p0, p1, p2 = stands[b, 0], stands[b, 1], stands[b, 2]
    uu, found = extent * extent, 0
    inverse = 1.0 / uu if uu > 0.0 else 0.0
    for k in range(LANES):
        x, y, z = p0 - ends[a, _X + k], p1 - ends[a, _Y + k], p2 - ends[a, _Z + k]
        u, v, w = ends[a, _U + k], ends[a, _V + k], ends[a, _W + k]
        s = clamped((x * u + y * v + z * w) * inverse)
        x, y, z = x - s * u, y - s * v, z - s * w
        found |= _verdict(x * x + y * y + z * z, apart, travel[a, 0, k]) << k
    return found


@kernel
def plane_verdict(a, plane, apart, ways):
    """A capsule and a half-space, n . x <= offset: d = n . m - |n . v| - offset - r."""
    n0, n1, n2, offset = plane[0], plane[1], plane[2], plane[3]
    found = 0
    for k in range(LANES):
        height = n0 * a[_X + k] + n1 * a[_Y + k] + n2 * a[_Z + k] - offset
        lean = n0 * a[_U + k] + n1 * a[_V + k] + n2 * a[_W + k]
        low = height - abs(lean) - apart
        contact = 0 if low > 0.0 else (1 << LANES)
        found |= ((0 if low > ways[k] else 1) | contact) << k
    return found


@kernel
def box_verdict(a, pose, half, extent, apart, ways):
    """A capsule and a box: exactly where the sphere around the capsule does not tell."""
    near, found = near_box(a, pose, half, apart + extent, 1.0, ways), 0
    if near == 0:
        return 0
    for k in range(LANES):
        if near >> k & 1:
            start, core = core_of(a, k)
            gap = segment_box_distance(
                into_frame(pose, start), rotated_back(pose, core), vector(half)
            )
            found |= _gap_verdict(gap, apart, ways[k]) << k
    return found


@kernel
def hull_verdict(a, hulls, row, extent, apart, ways):
    """A capsule and a convex hull: exactly where the spheres around both do not tell."""
    near = near_point(a, hulls.around[row], apart + extent + hulls.around[row, 3], 1.0, ways)
    if near == 0:
        return 0
    found, polytope = 0, solid_of(hulls, row)
    for k in range(LANES):
        if near >> k & 1:
            start, core = core_of(a, k)
            gap = segment_polytope(start, core, polytope)[0]
            found |= _gap_verdict(gap, apart, ways[k]) << k
    return found


@inlined
def _gap_verdict(gap, apart, way):
    """Bits 0 and LANES of a lane from a distance, which may be negative."""
    return (0 if gap > apart + way else 1) | (0 if gap > apart else (1 << LANES))
