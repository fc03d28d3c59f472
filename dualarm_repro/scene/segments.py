"""Closest points of two segments, the core of every distance between spheres and capsules.

A capsule is its core segment inflated by a radius. The Minkowski difference of two segments is a
flat parallelogram, so that even where the cores cross the shortest translation that separates two
capsules is the sum of the radii: the signed distance is |core distance| - r_a - r_b everywhere.
"""

from __future__ import annotations

from ..kernel import kernel
from .vectors import along, cross, dot, minus, perpendicular, scaled

# Cores nearer than this [m] meet: the difference of the witness points is noise, no direction.
CORES_MEET = 1e-10
# Squared sine below which two segments count as parallel; the distance errs by 1e-10 of a length.
PARALLEL = 1e-20
# An exit past an edge must be shorter than one through a face by more than rounding [m]: where an
# edge axis coincides with a face normal, only the face knows where the bodies touch.
ROUNDING = 1e-12


@kernel
def clamped(s, low, high):
    """s limited to [low, high]."""
    return min(max(s, low), high)


@kernel
def lowest(low, high, climb):
    """Parameter in [low, high] where a height of slope ``climb`` is least; of many, the middle."""
    if abs(climb) <= CORES_MEET:
        return 0.5 * (low + high)
    return low if climb > 0.0 else high


@kernel
def projected(p, a, u, uu):
    """Parameter in [0, 1] of the point of the segment a + s u nearest to p; uu = u . u."""
    return clamped(dot(minus(p, a), u) / (uu if uu > 0.0 else 1.0), 0.0, 1.0)


@kernel
def closest_parameters(a, u, b, v):
    """argmin |a + s u - b - t v| over s, t in [0, 1].

    The stationary point of the lines, s = det(b - a, v, u x v) / |u x v|^2, is clamped to its
    segment, the point there projected to the other segment and that one back: exact, since the
    squared distance is convex, and without branches. Determinants keep the parameters accurate for
    nearly parallel segments. For parallel ones the middle of the common stretch is taken.
    """
    w = cross(u, v)
    uu, vv, ww = dot(u, u), dot(v, v), dot(w, w)
    if ww > PARALLEL * uu * vv:
        s = clamped(dot(cross(minus(b, a), v), w) / ww, 0.0, 1.0)
    else:
        s = 0.5 * (projected(b, a, u, uu) + projected(along(b, 1.0, v), a, u, uu))
    t = projected(along(a, s, u), b, v, vv)
    return projected(along(b, t, v), a, u, uu), t


@kernel
def segment_segment(a, u, b, v):
    """Distance of the segments a + [0, 1] u and b + [0, 1] v, their nearest points, the normal.

    Where the cores meet the normal is u x v; of parallel cores, any direction normal to them
    (:func:`.vectors.perpendicular`); of two coinciding points, e_z. Each is a direction along
    which the shortest separating translation of the inflated segments points.

    Returns
    -------
    distance, point_a, point_b, normal
        ``distance >= 0``; the unit normal points from a to b.
    """
    s, t = closest_parameters(a, u, b, v)
    p = along(a, s, u)
    q = along(b, t, v)
    gap = minus(q, p)
    distance = dot(gap, gap) ** 0.5
    if distance > CORES_MEET:
        return distance, p, q, scaled(1.0 / distance, gap)
    w = cross(u, v)
    uu, vv, ww = dot(u, u), dot(v, v), dot(w, w)
    if ww > PARALLEL * uu * vv:
        normal = scaled((1.0 if dot(gap, w) >= 0.0 else -1.0) / ww**0.5, w)
    else:
        normal = perpendicular(u if uu >= vv else v)
    return distance, p, q, normal
