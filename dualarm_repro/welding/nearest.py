"""Smallest distance of many capsules over a path, with the pairs that are far apart left out."""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from ..scene.segments import closest_parameters
from ..scene.vectors import along, dot, minus, vector


@kernel
def smallest_distances(ends, radius, pairs, above, height, count):
    """min over ``count`` consecutive rows and all pairs of |core distance| - r_a - r_b.

    A pair is skipped where the distance of the balls around both capsules, which is never larger,
    exceeds the smallest distance met so far.

    Parameters
    ----------
    ends : (P count, C, 2, 3)
        Ends of the cores [m].
    radius : (C,)
        [m]
    pairs : (K, 2)
        Rows of the capsules.
    above : (F,)
        Rows of the capsules that must stay above the plane z = ``height``.

    Returns
    -------
    ndarray (P,) [m]
    """
    capsules = len(radius)
    centre, reach = np.empty((capsules, 3)), np.empty(capsules)
    for c in range(capsules):
        core = minus(vector(ends[0, c, 1]), vector(ends[0, c, 0]))
        reach[c] = 0.5 * dot(core, core) ** 0.5 + radius[c]
    out = np.empty(len(ends) // count)
    for p in range(len(out)):
        best = np.inf
        for n in range(p * count, (p + 1) * count):
            for c in range(capsules):
                for r in range(3):
                    centre[c, r] = 0.5 * (ends[n, c, 0, r] + ends[n, c, 1, r])
            for k in range(len(above)):
                c = above[k]
                low = min(ends[n, c, 0, 2], ends[n, c, 1, 2])
                best = min(best, low - height - radius[c])
            for k in range(len(pairs)):
                i, j = pairs[k]
                apart = minus(vector(centre[i]), vector(centre[j]))
                needed = best + reach[i] + reach[j]
                if needed <= 0.0 or dot(apart, apart) >= needed * needed:
                    continue
                a, b = vector(ends[n, i, 0]), vector(ends[n, j, 0])
                u, v = minus(vector(ends[n, i, 1]), a), minus(vector(ends[n, j, 1]), b)
                s, t = closest_parameters(a, u, b, v)
                gap = minus(along(b, t, v), along(a, s, u))
                best = min(best, dot(gap, gap) ** 0.5 - radius[i] - radius[j])
        out[p] = best
    return out
