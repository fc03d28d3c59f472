"""Which pairs say nothing about self-collision: judged by the exact shapes in sampled postures.

The rule for shapes is that of the default self-collision matrix of MoveIt (I. A. Sucan and
S. Chitta): pairs that touch always, or never, are left out. Here "never" needs evidence: capsules
of the pair have to overlap, with the shapes apart, in many of the postures. Of the other pairs
those capsules are left out that raise many false alarms and are not needed: in every sampled
posture in which the shapes touch, or nearly do, other capsules of the pair overlap too.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from ..exclusions import Evidence, Exclusion, shape_of

SAMPLES = 2000  # postures
FLAGGED = 40  # of them, in which a pair has to raise a false alarm before "never" counts
MOST = 0.5  # share of postures in which a pair touches that touches at the home pose for good
NOISY = 0.005  # share of postures in which a pair that is watched may raise a false alarm
NEAR = 3e-3  # shapes nearly touch at this distance [m]


class Judged(NamedTuple):
    """Pairs left out, the shapes of which other pairs still raise many false alarms, and the share
    of free postures in which any does."""

    exclusions: list[Exclusion]
    noisy: set[str]
    alarms: float


def judge(model: pin.Model, solids: pin.GeometryModel, capsules: pin.GeometryModel) -> Judged:
    """Pairs of shapes and of capsules that are left out, among those two or more joints apart.

    Parameters
    ----------
    model
        Of the chain; its limits are those of the postures, a turn where they are infinite.
    solids
        The exact shapes.
    capsules
        Those around them, named ``shape`` or ``shape.k``.
    """
    pairs, found, noisy = watched_pairs(solids), list[Exclusion](), set[str]()
    if not pairs:
        return Judged(found, noisy, 0.0)
    q = postures(model, SAMPLES)
    near = contacts(model, solids, pairs, q, NEAR)
    touching = near.copy()
    touching[near.any(axis=1)] = contacts(model, solids, pairs, q[near.any(axis=1)])
    home = contacts(model, solids, pairs, home_pose(model)[np.newaxis])[0]
    names = [shape.name for shape in solids.geometryObjects]
    flagged, struck = (np.zeros(len(q), dtype=bool) for _ in range(2))
    for k, (of_pair, hits) in enumerate(_overlaps(model, names, capsules, pairs, q)):
        first, second = (names[i] for i in pairs[k])
        count, alarms = int(touching[:, k].sum()), int(hits.any(axis=1).sum())
        if count == len(q):
            evidence = Evidence.ALWAYS
        elif home[k] and count > MOST * len(q):
            evidence = Evidence.HOME
        elif count == 0 and not home[k] and alarms >= FLAGGED:
            evidence = Evidence.NEVER
        else:
            needed = near[:, k] if near[:, k].mean() <= MOST else touching[:, k]
            dropped = _not_needed(hits, needed, touching[:, k])
            for c in dropped:
                both = count, len(q), int(hits[:, c].sum())
                found.append(Exclusion(*of_pair[c], Evidence.NOT_NEEDED, *both))
            kept = np.delete(hits, dropped, axis=1).any(axis=1)
            if (kept & ~touching[:, k]).mean() > NOISY:
                noisy.update((first, second))
            flagged |= kept
            struck |= touching[:, k]
            continue
        found.append(Exclusion(first, second, evidence, count, len(q), alarms))
    return Judged(found, noisy, float(flagged[~struck].mean()) if not struck.all() else 0.0)


def _not_needed(hits: np.ndarray, needed: np.ndarray, touching: np.ndarray) -> list[int]:
    """Columns of ``hits`` (N, C) that raise false alarms, worst first, until next to none is left,
    as long as the others hit in every posture that is ``needed`` (N,) and that any hits."""
    false = hits & ~touching[:, None]
    covered, alarms, dropped = hits[needed].sum(axis=1), false.sum(axis=1), []
    for c in np.argsort(-false.sum(axis=0), kind="stable"):
        if np.count_nonzero(alarms) <= 0.2 * NOISY * len(hits):
            break
        rest = covered - hits[needed, c]
        if false[:, c].any() and (rest[covered > 0] > 0).all():
            covered, alarms = rest, alarms - false[:, c]
            dropped.append(int(c))
    return dropped


def watched_pairs(solids: pin.GeometryModel) -> list[tuple[int, int]]:
    """Indices of shapes whose joints are two or more apart."""
    joints = [shape.parentJoint for shape in solids.geometryObjects]
    return [
        (i, j)
        for i in range(len(joints))
        for j in range(i + 1, len(joints))
        if abs(joints[i] - joints[j]) > 1
    ]


def usual_range(model: pin.Model) -> tuple[np.ndarray, np.ndarray]:
    """Limits of the joints, a turn about 0 where there are none."""
    lower, upper = model.lowerPositionLimit, model.upperPositionLimit
    return np.where(np.isinf(lower), -np.pi, lower), np.where(np.isinf(upper), np.pi, upper)


def postures(model: pin.Model, count: int, seed: int = 0) -> np.ndarray:
    """Postures (N, nq) drawn uniformly within the limits."""
    lower, upper = usual_range(model)
    return lower + np.random.default_rng(seed).random((count, model.nq)) * (upper - lower)


def home_pose(model: pin.Model) -> np.ndarray:
    """All joints zero, or as near to it as their limits allow."""
    found: np.ndarray = np.clip(np.zeros(model.nq), *usual_range(model))
    return found


def contacts(
    model: pin.Model,
    shapes: pin.GeometryModel,
    pairs: Sequence[tuple[int, int]],
    q: np.ndarray,
    near: float = 0.0,
) -> np.ndarray:
    """Whether shapes come nearer than ``near`` [m], for every posture (N, nq) and pair: (N, P)."""
    shapes.removeAllCollisionPairs()
    for i, j in pairs:
        shapes.addCollisionPair(pin.CollisionPair(i, j))
    data, geometry = model.createData(), shapes.createData()
    results = geometry.collisionResults
    for request in geometry.collisionRequests:
        request.security_margin = near
    found = np.zeros((len(q), len(shapes.collisionPairs)), dtype=bool)
    for row, posture in zip(found, q, strict=True):
        if pin.computeCollisions(model, data, shapes, geometry, posture, False):
            for k in range(len(row)):
                row[k] = results[k].isCollision()
    shapes.removeAllCollisionPairs()
    return found


def _overlaps(
    model: pin.Model,
    names: Sequence[str],
    capsules: pin.GeometryModel,
    pairs: Sequence[tuple[int, int]],
    q: np.ndarray,
) -> list[tuple[list[tuple[str, str]], np.ndarray]]:
    """Of every pair of shapes its pairs of capsules by name, and whether these overlap (N, C)."""
    of_shape = defaultdict(list)
    for c, capsule in enumerate(capsules.geometryObjects):
        of_shape[shape_of(capsule.name)].append(c)
    groups = [[(a, b) for a in of_shape[names[i]] for b in of_shape[names[j]]] for i, j in pairs]
    hits = contacts(model, capsules, [pair for group in groups for pair in group], q)
    ends = np.cumsum([len(group) for group in groups])[:-1]
    called = [one.name for one in capsules.geometryObjects]
    return [
        ([(called[a], called[b]) for a, b in group], part)
        for group, part in zip(groups, np.split(hits, ends, axis=1), strict=True)
    ]
