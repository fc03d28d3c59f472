"""The smallest capsule around points along given directions, compiled.

For a direction u the radius is that of the smallest circle around the points seen along u (found by
the iteration of M. Badoiu and K. L. Clarkson, Smaller core-sets for balls, SODA 2003), or a little
more where the ends become so much shorter that the volume pi r^2 l + 4/3 pi r^3 falls.
"""

from __future__ import annotations

import math

import numpy as np

from ...copies import copy_row
from ...kernel import kernel

_TURNS = 40  # steps of the iteration for the circle
_GROWTHS = (1.0, 1.02, 1.06, 1.12, 1.2, 1.35)  # radii tried, over that of the circle


@kernel
def along(points, u, out):
    """Capsule with axis u around points (N, 3): ends and radius into ``out`` (7,); its volume."""
    k = 0
    for r in range(1, 3):
        if abs(u[r]) < abs(u[k]):
            k = r
    e = np.zeros(3)
    e[k] = 1.0
    e -= u[k] * u
    e /= np.sqrt((e * e).sum())
    f = np.array([u[1] * e[2] - u[2] * e[1], u[2] * e[0] - u[0] * e[2], u[0] * e[1] - u[1] * e[0]])
    count = len(points)
    flat = np.empty((count, 3))
    for i in range(count):
        p = points[i]
        flat[i, 0] = e[0] * p[0] + e[1] * p[1] + e[2] * p[2]
        flat[i, 1] = f[0] * p[0] + f[1] * p[1] + f[2] * p[2]
        flat[i, 2] = u[0] * p[0] + u[1] * p[1] + u[2] * p[2]
    x = 0.5 * (flat[:, 0].min() + flat[:, 0].max())
    y = 0.5 * (flat[:, 1].min() + flat[:, 1].max())
    radius, centre_x, centre_y = np.inf, x, y
    for turn in range(_TURNS):
        far, square = 0, -1.0
        for i in range(count):
            d = (flat[i, 0] - x) ** 2 + (flat[i, 1] - y) ** 2
            if d > square:
                far, square = i, d
        if np.sqrt(square) < radius:
            radius, centre_x, centre_y = np.sqrt(square), x, y
        x += (flat[far, 0] - x) / (turn + 2.0)
        y += (flat[far, 1] - y) / (turn + 2.0)
    best = np.inf
    for growth in _GROWTHS:
        R = growth * radius
        low, high = np.inf, -np.inf
        for i in range(count):
            d = (flat[i, 0] - centre_x) ** 2 + (flat[i, 1] - centre_y) ** 2
            bulge = np.sqrt(max(R * R - d, 0.0))
            low, high = min(low, flat[i, 2] + bulge), max(high, flat[i, 2] - bulge)
        if low > high:
            low = high = 0.5 * (low + high)
        volume = math.pi * R * R * (high - low + 4.0 / 3.0 * R)
        if volume < best:
            best = volume
            for r in range(3):
                across = centre_x * e[r] + centre_y * f[r]
                out[r], out[3 + r] = across + low * u[r], across + high * u[r]
            out[6] = R
    return best


@kernel
def smallest(points, directions, out):
    """The smallest of the capsules along the rows of ``directions`` (D, 3), and its volume."""
    best, trial = np.inf, np.empty(7)
    for k in range(len(directions)):
        volume = along(points, directions[k], trial)
        if volume < best:
            best = volume
            copy_row(trial, out)
    return best


@kernel
def refined(points, directions, steps, out):
    """As :func:`smallest`, then turned towards a smaller volume by ever smaller angles."""
    best = smallest(points, directions, out)
    trial, u = np.empty(7), np.empty(3)
    for r in range(3):
        u[r] = out[3 + r] - out[r]
    length = np.sqrt((u * u).sum())
    if length == 0.0:
        return best
    u /= length
    angle = 0.25
    for _ in range(steps):
        k = np.argmin(np.abs(u))
        e = np.zeros(3)
        e[k] = 1.0
        e -= u[k] * u
        e /= np.sqrt((e * e).sum())
        f = np.array(
            [u[1] * e[2] - u[2] * e[1], u[2] * e[0] - u[0] * e[2], u[0] * e[1] - u[1] * e[0]]
        )
        better = False
        for side in range(4):
            turn = e if side < 2 else f
            v = u + (angle if side % 2 else -angle) * turn
            v /= np.sqrt((v * v).sum())
            volume = along(points, v, trial)
            if volume < best:
                best, better = volume, True
                copy_row(trial, out)
                chosen = v
        if better:
            u = chosen
        else:
            angle *= 0.5
    return best


@kernel
def covered(points, capsule, inside):
    """Mark in ``inside`` (N,) of bool which points (N, 3) lie in a capsule (7,), beside those that
    are marked."""
    a, u = capsule[:3], capsule[3:6] - capsule[:3]
    square, R = (u * u).sum(), capsule[6] * capsule[6]
    for i in range(len(points)):
        x, y, z = points[i, 0] - a[0], points[i, 1] - a[1], points[i, 2] - a[2]
        s = x * u[0] + y * u[1] + z * u[2]
        s = min(max(s / square, 0.0), 1.0) if square > 0.0 else 0.0
        x, y, z = x - s * u[0], y - s * u[1], z - s * u[2]
        if x * x + y * y + z * z <= R:
            inside[i] = True


@kernel
def cut(triangles, normal, offset):
    """Parts of triangles (T, 3, 3) with normal . p <= offset, and with >= offset, as triangles."""
    count = len(triangles)
    below, above = np.empty((2 * count, 3, 3)), np.empty((2 * count, 3, 3))
    b = a = 0
    d, polygon = np.empty(3), np.empty((4, 3))
    for t in range(count):
        for i in range(3):
            p = triangles[t, i]
            d[i] = normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] - offset
        if d.max() <= 0.0:
            below[b] = triangles[t]
            b += 1
            continue
        if d.min() >= 0.0:
            above[a] = triangles[t]
            a += 1
            continue
        for sign in (-1.0, 1.0):
            n = 0
            for i in range(3):
                j = (i + 1) % 3
                if sign * d[i] >= 0.0:
                    polygon[n] = triangles[t, i]
                    n += 1
                if d[i] * d[j] < 0.0:
                    s = d[i] / (d[i] - d[j])
                    polygon[n] = triangles[t, i] + s * (triangles[t, j] - triangles[t, i])
                    n += 1
            for i in range(1, n - 1):
                if sign < 0.0:
                    below[b, 0], below[b, 1], below[b, 2] = polygon[0], polygon[i], polygon[i + 1]
                    b += 1
                else:
                    above[a, 0], above[a, 1], above[a, 2] = polygon[0], polygon[i], polygon[i + 1]
                    a += 1
    return below[:b], above[:a]
