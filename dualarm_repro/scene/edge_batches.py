"""Freedom of contact of many straight joint edges, whose stretches share the SIMD lanes.

As :mod:`.edge_kernels`, but an edge begins as two stretches only: a block is filled with stretches
of other edges, so that no lane looks at what a longer stretch would have made certain. Stretches
that are not certain are halved and wait on a stack, the shortest on top.
"""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from .edge_kernels import PLACES, place_block
from .lane_distances import LANES
from .lane_verdicts import (
    ball_verdict,
    box_verdict,
    hull_verdict,
    near_spheres,
    near_standing,
    plane_verdict,
    queue_capsules,
    queue_standing,
    queue_verdict,
)

#: Stretches that may wait. Of the stretches of one length or shorter ones at most 2 LANES are added
#: at a time, and none longer before fewer than LANES are left: enough for 62 halvings.
_WAITING = 64 * LANES


@kernel
def edges_free(model, starts, ends, margin, free, looked):
    """Whether every pair keeps more than ``margin`` [m] all along each edge (E, nq), into ``free``
    (E,), and the number of configurations that were looked at, into ``looked`` (E,).

    Where a pair keeps the margin by less than ``model.finest`` [m] the edge counts as not free.
    """
    edges, (capsules, joints) = len(starts), model.lever.shape
    w, turns = np.zeros(PLACES), np.zeros((3, joints * LANES))
    steps, placed = np.zeros((joints, LANES)), np.zeros((capsules, 6 * LANES))
    travel = np.zeros((capsules, joints + 1, LANES))
    lane, share = np.empty(LANES, np.int64), np.empty((LANES, 2))
    most = len(model.pairs) + len(model.standing_pairs) + 1
    queue, lanes = np.empty((most, 13, LANES)), np.empty((most, LANES), np.int64)
    owner, waiting = np.empty(_WAITING, np.int64), np.empty((_WAITING, 2))
    for n in range(edges):
        free[n], looked[n] = model.between_standing > margin, 0
    begun, count = 0, 0
    while True:
        rows = 0
        while rows < LANES:
            if count == 0:
                while begun < edges and not free[begun]:
                    begun += 1
                if begun == edges:
                    break
                for k in range(2):
                    owner[k], waiting[k, 0], waiting[k, 1] = begun, 0.75 - 0.5 * k, 0.25
                begun, count = begun + 1, 2
            count -= 1
            edge = owner[count]
            if free[edge]:
                lane[rows] = edge
                share[rows, 0], share[rows, 1] = waiting[count, 0], waiting[count, 1]
                looked[edge] += 1
                rows += 1
        if rows == 0:
            return
        for k in range(LANES):
            row = min(k, rows - 1)
            edge, at, half = lane[row], share[row, 0], share[row, 1]
            for j in range(joints):
                change = ends[edge, j] - starts[edge, j]
                turns[0, j * LANES + k] = starts[edge, j] + at * change
                steps[j, k] = half * abs(change)
        set_travels(model, steps, travel)
        place_block(model, w, turns, placed)
        found = verdict(model, margin, travel, placed, queue, lanes)
        for k in range(rows):
            if found >> (LANES + k) & 1:
                free[lane[k]] = False
        for k in range(rows - 1, -1, -1):
            edge = lane[k]
            if found >> k & 1 and free[edge]:
                widest = 0.0
                for c in range(capsules):
                    widest = max(widest, travel[c, 0, k])
                if count + 2 > _WAITING or widest < model.finest:
                    free[edge] = False
                    continue
                at, half = share[k, 0], 0.5 * share[k, 1]
                for one in range(2):
                    owner[count], waiting[count, 1] = edge, half
                    waiting[count, 0] = at + half if one == 0 else at - half
                    count += 1


@kernel
def set_travels(model, steps, travel):
    """Way of every capsule over half a stretch by the joints from j on, ``travel[c, j]`` (LANES,)
    [m], from the ways of the joints ``steps`` (n, LANES); of all of them also where j = 0."""
    for c in range(len(travel)):
        first, after = model.moved[c]
        for j in range(after - 1, first - 1, -1):
            _add(travel[c, j + 1], model.lever[c, j], steps[j], travel[c, j])
        if first > 0:
            _add(travel[c, first], 0.0, steps[0], travel[c, 0])


@kernel
def _add(a, factor, b, out):
    for k in range(LANES):
        out[k] = a[k] + factor * b[k]


@kernel
def verdict(model, margin, travel, ends, queue, lanes):
    """Bits of the lanes whose stretches are not certain, and bits LANES on of those in contact."""
    found, count, radius, extent = 0, 0, model.radius, model.extent
    for n in range(len(model.pairs)):
        a, b, from_a, from_b = model.pairs[n]
        apart, far = radius[a] + radius[b] + margin, extent[a] + extent[b]
        near = near_spheres(ends, a, b, apart + far, travel, from_a, from_b)
        if near:
            squares = extent[a] * extent[a], extent[b] * extent[b]
            count = queue_capsules(
                queue, lanes, count, near, ends, a, b, *squares, apart, travel, from_a, from_b
            )
    for n in range(len(model.standing_pairs)):
        a, b = model.standing_pairs[n]
        apart, long = radius[a] + model.standing_radius[b] + margin, model.standing_extent[b]
        if long == 0.0:
            found |= ball_verdict(ends, a, model.standing, b, extent[a], apart, travel)
            continue
        near = near_standing(ends, a, model.standing, b, apart + extent[a] + long, travel)
        if near:
            squares = extent[a] * extent[a], long * long
            count = queue_standing(
                queue, lanes, count, near, ends, a, model.standing, b, *squares, apart, travel
            )
    found |= queue_verdict(queue, lanes, count)
    for n in range(len(model.plane_pairs)):
        a, b = model.plane_pairs[n]
        found |= plane_verdict(ends[a], model.planes[b], radius[a] + margin, travel[a, 0])
    for n in range(len(model.box_pairs)):
        a, b = model.box_pairs[n]
        apart = radius[a] + margin
        found |= box_verdict(ends[a], model.boxes[b], model.half[b], extent[a], apart, travel[a, 0])
    for n in range(len(model.hull_pairs)):
        a, b = model.hull_pairs[n]
        found |= hull_verdict(ends[a], model.hulls, b, extent[a], radius[a] + margin, travel[a, 0])
    return found
