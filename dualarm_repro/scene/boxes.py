"""Signed distance of a segment or a point to a box, in the frame of the box (half edges h).

Outside, the squared distance is sum_i e_i(t)^2 with the excess e_i = p_i - clamp(p_i, -h_i, h_i) of
p(t) = a + t u. Its derivative 2 u . e(t) is continuous, never falls and is linear between the
parameters where p crosses a face plane, so that its root is found exactly.

Inside, the signed distance is minus the length of the shortest translation that parts the two. The
box swept along -u is bounded by the planes of the three faces and of the three edge directions
crossed with u, so that the shortest translation is along one of these six axes.
"""

from __future__ import annotations

from ..kernel import kernel
from .segments import CORES_MEET, ROUNDING, clamped, lowest
from .vectors import along, cross, dot, scaled

# Below this distance [m] the root of the slope may err by more than 1e-10 in the distance.
NEAR_CONTACT = 1e-6


@kernel
def excess(p, h):
    """Vector from the nearest point of the box to p; zero inside."""
    return (
        p[0] - clamped(p[0], -h[0], h[0]),
        p[1] - clamped(p[1], -h[1], h[1]),
        p[2] - clamped(p[2], -h[2], h[2]),
    )


@kernel
def closest_parameter(a, u, h):
    """argmin of the distance of a + t u to the box over t in [0, 1]; of several, the middle."""
    low, slope_low = 0.0, dot(u, excess(a, h))
    high, slope_high = 1.0, dot(u, excess(along(a, 1.0, u), h))
    if slope_low > 0.0:
        return 0.0
    if slope_high < 0.0:
        return 1.0
    flat_low = 0.0 if slope_low == 0.0 else 2.0
    flat_high = 1.0 if slope_high == 0.0 else -1.0
    for k in range(6):
        i = k // 2
        t = ((h[i] if k % 2 else -h[i]) - a[i]) / u[i]
        if low < t < high:
            slope = dot(u, excess(along(a, t, u), h))
            if slope < 0.0:
                low, slope_low = t, slope
            elif slope > 0.0:
                high, slope_high = t, slope
            else:
                flat_low, flat_high = min(flat_low, t), max(flat_high, t)
    if flat_low <= flat_high:
        return 0.5 * (flat_low + flat_high)
    return low + (high - low) * slope_low / (slope_low - slope_high)


@kernel
def nearest_point(a, u, h):
    """Point of a + [0, 1] u nearest to the box, its excess and distance.

    Near contact the slope drowns in rounding, while the distances at the breakpoints stay exact.
    """
    p = along(a, closest_parameter(a, u, h), u)
    e = excess(p, h)
    distance = dot(e, e) ** 0.5
    if 0.0 < distance < NEAR_CONTACT:
        for k in range(8):
            i = k // 2
            t = float(k % 2) if i == 3 else ((h[i] if k % 2 else -h[i]) - a[i]) / u[i]
            if 0.0 <= t <= 1.0:
                other = along(a, t, u)
                f = excess(other, h)
                if dot(f, f) ** 0.5 < distance - ROUNDING:
                    p, e, distance = other, f, dot(f, f) ** 0.5
    return p, e, distance


@kernel
def shortest_exit(a, u, h):
    """Depth and unit direction of the shortest translation that takes a + [0, 1] u out of the box.

    Returns
    -------
    depth, direction, axis
        ``axis`` 0..2: a face normal; 3..5: edge direction ``axis - 3`` crossed with u.
    """
    depth, direction, axis = 1e300, (0.0, 0.0, 1.0), 0
    for k in range(3):
        low, high = min(a[k], a[k] + u[k]), max(a[k], a[k] + u[k])
        if h[k] - low < depth:
            depth, direction, axis = h[k] - low, unit(k, 1.0), k
        if h[k] + high < depth:
            depth, direction, axis = h[k] + high, unit(k, -1.0), k
    for k in range(3):  # edges of the box crossed with u
        m = cross(unit(k, 1.0), u)
        length = dot(m, m) ** 0.5
        if length == 0.0:
            continue
        m = scaled(1.0 / length, m)
        offset = dot(m, a)
        reach = h[0] * abs(m[0]) + h[1] * abs(m[1]) + h[2] * abs(m[2])
        if reach - abs(offset) < depth - ROUNDING:
            sign = 1.0 if offset >= 0.0 else -1.0
            depth, direction, axis = reach - abs(offset), scaled(sign, m), 3 + k
    return depth, direction, axis


@kernel
def unit(k, sign):
    """Coordinate direction k with a sign."""
    return sign * (k == 0), sign * (k == 1), sign * (k == 2)


@kernel
def deepest_parameter(a, u, h, direction, axis):
    """Parameter of the point of a + [0, 1] u that touches the box last on its way out."""
    if axis >= 3:
        k = axis - 3
        i, j = (k + 1) % 3, (k + 2) % 3
        depth = h[i] * abs(direction[i]) + h[j] * abs(direction[j]) - dot(direction, a)
        if abs(u[j]) > abs(u[i]):
            i = j
        edge = h[i] if direction[i] > 0.0 else -h[i]
        return clamped((edge - a[i] - depth * direction[i]) / u[i], 0.0, 1.0)
    low, high = 0.0, 1.0  # the part that leaves through this face
    for i in range(3):
        if i != axis and abs(u[i]) > CORES_MEET:
            t1, t2 = (-h[i] - a[i]) / u[i], (h[i] - a[i]) / u[i]
            low, high = max(low, min(t1, t2)), min(high, max(t1, t2))
    return lowest(low, high, dot(direction, u))


@kernel
def segment_box(a, u, h):
    """Signed distance of a + [0, 1] u to the box, nearest points, unit normal segment to box.

    Inside, the points are the deepest point of the segment and where the shortest exit takes it.

    Returns
    -------
    distance, point_segment, point_box, normal
    """
    p, e, distance = nearest_point(a, u, h)
    if not distance <= CORES_MEET:  # NaN has no exit, and stays
        return distance, p, along(p, -1.0, e), scaled(-1.0 / distance, e)
    depth, direction, axis = shortest_exit(a, u, h)
    p = along(a, deepest_parameter(a, u, h, direction, axis), u)
    return -depth, p, along(p, depth, direction), scaled(-1.0, direction)


@kernel
def segment_box_distance(a, u, h):
    """The distance of :func:`segment_box` alone."""
    distance = nearest_point(a, u, h)[2]
    return -shortest_exit(a, u, h)[0] if distance <= CORES_MEET else distance
