"""Freedom of contact of straight joint edges, certified, many configurations in SIMD lanes.

Along q(s) = a + s (b - a) a pair of bodies moves by at most w relative to each other (levers of
:mod:`.certificate`). Where its distance at s exceeds the margin by more than w h, the whole
stretch [s - h, s + h] is free. An edge begins as ``LANES`` stretches; those that are not certain
are halved.

The poses of a block of configurations lie in one flat buffer at constant places, and a pair is
looked at in a loop that only reads and gathers bits, so that both become SIMD code.
"""

from __future__ import annotations

import numpy as np

from ..arms.trigonometry import sincos
from ..kernel import kernel
from .lane_distances import (
    LANES,
    far_apart,
    near_point,
    unsure_ball,
    unsure_box,
    unsure_capsules,
    unsure_hull,
    unsure_plane,
    unsure_standing,
)

#: Stretches that may wait to be looked at; an edge that needs more counts as not free.
_WAITING = 512
# Places in the buffer of a block: sine, cosine, rotation (row major), origin, parameter, half
# stretch.
_COS, _ROT, _POS, _AT, _HALF = (k * LANES for k in (1, 2, 11, 14, 15))
PLACES = 16 * LANES


@kernel
def edge_buffers(model):
    """Buffers for :func:`edge_free`: pose of a block, sines and cosines, half stretches,
    capsules (middle and half core), ways of the capsules, stretches that wait."""
    capsules, joints = model.lever.shape
    return (
        np.zeros(PLACES),
        np.zeros((3, joints * LANES)),
        np.zeros(LANES),
        np.zeros((capsules, 6 * LANES)),
        np.zeros((capsules, joints + 1)),
        np.zeros((_WAITING, 2)),
    )


@kernel
def edge_free(model, start, end, margin, known, buffers):
    """Whether every pair keeps more than ``margin`` [m] all along an edge from ``start`` to ``end``
    (nq,), and the number of configurations that were looked at.

    ``known``: pairs that do not move relative to each other are known to keep it. Where a pair
    keeps the margin by less than ``model.finest`` [m] the edge counts as not free.
    """
    w, turns, halves, ends, travel, waiting = buffers
    if model.between_standing <= margin:
        return False, 0
    widest = set_travel(model, start, end, travel)
    count, half = (LANES, 0.5 / LANES) if widest > 0.0 else (1, 0.5)
    for k in range(count):
        waiting[k, 0], waiting[k, 1] = (2 * k + 1) * half, half
    looked = 0
    while count:
        rows = min(count, LANES)
        count -= rows
        for k in range(LANES):
            row = count + min(k, rows - 1)
            w[_AT + k], w[_HALF + k] = waiting[row, 0], waiting[row, 1]
            halves[k] = waiting[row, 1]
        set_joints(start, end, w, turns)
        place_block(model, w, turns, ends)
        looked += rows
        unsure = unsure_lanes(model, margin, known, travel, halves, ends)
        if unsure < 0:
            return False, looked
        for k in range(rows):
            if unsure >> k & 1:
                half = 0.5 * w[_HALF + k]
                if count + 2 > _WAITING - LANES or half * widest < model.finest:
                    return False, looked
                waiting[count, 0], waiting[count, 1] = w[_AT + k] - half, half
                waiting[count + 1, 0], waiting[count + 1, 1] = w[_AT + k] + half, half
                count += 2
    return True, looked


@kernel
def set_travel(model, start, end, travel):
    """Way of every capsule over an edge by the joints from j on, ``travel[c, j]`` [m]; returns
    twice the longest."""
    joints, widest = len(start), 0.0
    for c in range(len(travel)):
        way = 0.0
        travel[c, joints] = 0.0
        for j in range(joints - 1, -1, -1):
            way += abs(end[j] - start[j]) * model.lever[c, j]
            travel[c, j] = way
        widest = max(widest, way)
    return 2.0 * widest


@kernel
def set_joints(start, end, w, turns):
    """Joints ``turns[0]`` [rad, m] at the parameters of a block."""
    for j in range(len(start)):
        base, change = start[j], end[j] - start[j]
        for k in range(LANES):
            turns[0, j * LANES + k] = base + w[_AT + k] * change


@kernel
def place_block(model, w, turns, ends):
    """Capsules ``ends`` of the controlled arms where ``turns[0]`` are the joints [rad, m]."""
    capsule = 0
    _set_turns(turns)
    for j in range(len(model.begins)):
        if model.slides[j]:
            for k in range(LANES):
                turns[1, j * LANES + k], turns[2, j * LANES + k] = 0.0, 1.0
        for k in range(LANES):
            w[k] = turns[1, j * LANES + k]
        for k in range(LANES):
            w[_COS + k] = turns[2, j * LANES + k]
        if model.begins[j]:
            _begin(model.rotation[j], model.translation[j], w)
        else:
            _advance(model.rotation[j], model.translation[j], w)
        if model.slides[j]:
            for r in range(3):
                for k in range(LANES):
                    way = turns[0, j * LANES + k]
                    w[_POS + r * LANES + k] += way * w[_ROT + (3 * r + 2) * LANES + k]
        for c in range(capsule, model.until[j]):
            _place(model.middle[c], model.core[c], w, ends[c])
        capsule = model.until[j]


@kernel
def _set_turns(turns):
    """Sine and cosine of all joints in all lanes, (3, n LANES)."""
    angle, sine, cosine = turns[0], turns[1], turns[2]
    for k in range(len(angle)):
        s, c = sincos(angle[k])
        sine[k] = s
        cosine[k] = c


@kernel
def _begin(C, t, w):
    """Pose C Rz(q) of the first joint of an arm."""
    for r in range(3):
        a, b, z, p = C[r, 0], C[r, 1], C[r, 2], t[r]
        for k in range(LANES):
            s, c = w[k], w[_COS + k]
            w[_ROT + 3 * r * LANES + k] = a * c + b * s
            w[_ROT + (3 * r + 1) * LANES + k] = b * c - a * s
            w[_ROT + (3 * r + 2) * LANES + k] = z
            w[_POS + r * LANES + k] = p


@kernel
def _advance(C, t, w):
    """Pose of the block times C Rz(q)."""
    c00, c01, c02, t0 = C[0, 0], C[0, 1], C[0, 2], t[0]
    c10, c11, c12, t1 = C[1, 0], C[1, 1], C[1, 2], t[1]
    c20, c21, c22, t2 = C[2, 0], C[2, 1], C[2, 2], t[2]
    for r in range(3):
        for k in range(LANES):
            s, c = w[k], w[_COS + k]
            a = w[_ROT + 3 * r * LANES + k]
            b = w[_ROT + (3 * r + 1) * LANES + k]
            z = w[_ROT + (3 * r + 2) * LANES + k]
            x = a * c00 + b * c10 + z * c20
            y = a * c01 + b * c11 + z * c21
            w[_ROT + 3 * r * LANES + k] = c * x + s * y
            w[_ROT + (3 * r + 1) * LANES + k] = c * y - s * x
            w[_ROT + (3 * r + 2) * LANES + k] = a * c02 + b * c12 + z * c22
            w[_POS + r * LANES + k] += a * t0 + b * t1 + z * t2


@kernel
def _place(middle, core, w, out):
    """Middle and half core of a capsule of the last joint."""
    x, y, z, u, v, h = middle[0], middle[1], middle[2], core[0], core[1], core[2]
    for r in range(3):
        for k in range(LANES):
            a = w[_ROT + 3 * r * LANES + k]
            b = w[_ROT + (3 * r + 1) * LANES + k]
            c = w[_ROT + (3 * r + 2) * LANES + k]
            out[r * LANES + k] = a * x + b * y + c * z + w[_POS + r * LANES + k]
            out[(3 + r) * LANES + k] = a * u + b * v + c * h


@kernel
def unsure_lanes(model, margin, known, travel, halves, ends):
    """Bits of the lanes whose stretches are not certain; -1 if a pair does not keep the margin."""
    unsure, radius, extent = 0, model.radius, model.extent
    for n in range(len(model.pairs)):
        a, b, from_a, from_b = model.pairs[n]
        way = travel[a, from_a] + travel[b, from_b]
        if known and way == 0.0:
            continue
        apart = radius[a] + radius[b] + margin
        if far_apart(ends[a], ends[b], apart + extent[a] + extent[b], way, halves):
            continue
        bits = unsure_capsules(ends[a], ends[b], extent[a], extent[b], apart, way, halves)
        if bits < 0:
            return -1
        unsure |= bits
    for n in range(len(model.standing_pairs)):
        a, b = model.standing_pairs[n]
        way = travel[a, 0]
        if known and way == 0.0:
            continue
        apart, long = radius[a] + model.standing_radius[b] + margin, model.standing_extent[b]
        if long == 0.0:
            bits = unsure_ball(ends[a], model.standing[b], extent[a], apart, way, halves)
        elif near_point(ends[a], model.standing[b], apart + extent[a] + long, way, halves):
            bits = unsure_standing(ends[a], model.standing[b], extent[a], long, apart, way, halves)
        else:
            bits = 0
        if bits < 0:
            return -1
        unsure |= bits
    for n in range(len(model.plane_pairs)):
        a, b = model.plane_pairs[n]
        bits = unsure_plane(ends[a], model.planes[b], radius[a] + margin, travel[a, 0], halves)
        if bits < 0:
            return -1
        unsure |= bits
    for n in range(len(model.box_pairs)):
        a, b = model.box_pairs[n]
        way, apart = travel[a, 0], radius[a] + margin
        if known and way == 0.0:
            continue
        bits = unsure_box(ends[a], model.boxes[b], model.half[b], extent[a], apart, way, halves)
        if bits < 0:
            return -1
        unsure |= bits
    for n in range(len(model.hull_pairs)):
        a, b = model.hull_pairs[n]
        way, apart = travel[a, 0], radius[a] + margin
        if known and way == 0.0:
            continue
        bits = unsure_hull(ends[a], model.hulls, b, extent[a], apart, way, halves)
        if bits < 0:
            return -1
        unsure |= bits
    return unsure
