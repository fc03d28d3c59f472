"""Which pairs say nothing about self-collision: judged by the exact shapes in sampled postures.

The rule for shapes is that of the default self-collision matrix of MoveIt (I. A. Sucan and
S. Chitta): pairs that are adjacent, or touch always, or never, are left out. "Never" is judged of
two capsules and what they contain of the shapes: the capsules have to overlap in many of the
postures, and their contents must not come near each other in any. A pair whose contents were seen
in contact is never left out, and its capsules overlap whenever the contents do.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from itertools import combinations

import coal
import numpy as np
import pinocchio as pin

from ..capsules import geometry_of
from ..exclusions import Evidence, Exclusion, shape_of
from .parts import Part
from .triangles import convex

SAMPLES = 2000  # postures of the whole arm
CLOSER = 1500  # postures of one pair, about those in which its capsules overlap
SPREAD = 0.12  # standard deviation of these, as share of a joint's range of at most one turn
FLAGGED = 20  # postures in which capsules have to overlap before "never" counts
MOST = 0.5  # share of postures in which a pair touches that touches at the home pose for good
NEAR = 2e-3  # contents are near each other at this distance [m]
NEIGHBOURS = 40  # postures in which adjacent shapes are looked at


def judge(model: pin.Model, solids: pin.GeometryModel, parts: Sequence[Part]) -> list[Exclusion]:
    """Pairs of shapes and of capsules that are left out.

    Parameters
    ----------
    model
        Of the chain; its limits are those of the postures, a turn where they are infinite.
    solids
        The exact shapes.
    parts
        The capsules around them, with what each contains.
    """
    found = _adjacent(model, solids)
    pairs = watched_pairs(solids)
    if not pairs:
        return found
    q = postures(model, SAMPLES)
    touching = contacts(model, solids, pairs, q)
    home = contacts(model, solids, pairs, home_pose(model)[np.newaxis])[0]
    names = [shape.name for shape in solids.geometryObjects]
    of_shape = defaultdict(list)
    for part in parts:
        of_shape[shape_of(part.capsule.name)].append(part)
    for k, (i, j) in enumerate(pairs):
        first, second, count = names[i], names[j], int(touching[:, k].sum())
        group = PairOfShapes(model, solids, (i, j), of_shape[first], of_shape[second])
        hits = group.overlaps(q)
        if count == len(q) or (home[k] and count > MOST * len(q)):
            evidence = Evidence.ALWAYS if count == len(q) else Evidence.HOME
            alarms = int(hits.any(axis=1).sum())
            found.append(Exclusion(first, second, evidence, count, len(q), alarms))
        else:
            found += group.never(q, hits, np.random.default_rng(k))
    return found


class PairOfShapes:
    """Two shapes of one arm, and every pair of a part of one and a part of the other."""

    def __init__(
        self,
        model: pin.Model,
        solids: pin.GeometryModel,
        pair: tuple[int, int],
        first: Sequence[Part],
        second: Sequence[Part],
    ) -> None:
        self._model, self._solids, self._pair = model, solids, pair
        self._parts = [(a, b) for a in first for b in second]
        self._hulls = _hulls([*first, *second])
        self._rows = [(a, len(first) + b) for a in range(len(first)) for b in range(len(second))]
        self.names = [(a.capsule.name, b.capsule.name) for a, b in self._parts]
        joints = sorted(solids.geometryObjects[k].parentJoint for k in pair)
        self._moving = slice(joints[0], joints[1])  # only these joints move one against the other

    def overlaps(self, q: np.ndarray) -> np.ndarray:
        """Whether hulls touch, of each pair in each posture (N, C)."""
        return contacts(self._model, self._hulls, self._rows, q)

    def never(self, q: np.ndarray, hits: np.ndarray, rng: np.random.Generator) -> list[Exclusion]:
        """Pairs of capsules that overlap often, though what they contain never comes near."""
        met = np.zeros(len(self._parts), dtype=bool)
        self._mark(q, hits, met)
        closer = self._closer(q[hits[:, ~met].any(axis=1)], rng)
        again = self.overlaps(closer)
        self._mark(closer, again, met)
        both = np.vstack([hits, again])
        counts = both.sum(axis=0)
        return [
            Exclusion(*self.names[c], Evidence.NEVER, 0, len(both), int(counts[c]))
            for c in np.flatnonzero(~met & (counts >= FLAGGED))
        ]

    def _closer(self, q: np.ndarray, rng: np.random.Generator) -> np.ndarray:
        """Postures about these, with the joints moved that move the pair."""
        if not len(q):
            return q
        made = q[rng.integers(len(q), size=CLOSER)]
        lower, upper = usual_range(self._model)
        sigma = SPREAD * np.minimum(upper - lower, 2.0 * np.pi)
        moved = np.clip(made + sigma * rng.normal(size=made.shape), lower, upper)
        made[:, self._moving] = moved[:, self._moving]
        return made

    def _mark(self, q: np.ndarray, hits: np.ndarray, met: np.ndarray) -> None:
        """Set ``met`` (C,) for parts that overlap somewhere and whose contents come near there."""
        rows = np.flatnonzero(hits.any(axis=1))
        rows = rows[contacts(self._model, self._solids, [self._pair], q[rows], NEAR)[:, 0]]
        data = self._model.createData()
        request = coal.CollisionRequest()
        request.security_margin = NEAR
        for n in rows:
            open_ = np.flatnonzero(hits[n] & ~met)
            if not len(open_):
                continue
            pin.forwardKinematics(self._model, data, q[n])
            for c in open_:
                placed = []
                for part in self._parts[c]:
                    one = part.content
                    at = data.oMi[one.parentJoint] * one.placement
                    placed += [one.geometry, coal.Transform3s(at.rotation, at.translation)]
                met[c] = coal.collide(*placed, request, coal.CollisionResult()) > 0


def _hulls(parts: Sequence[Part]) -> pin.GeometryModel:
    """The convex hulls in the frames of the joints; where there is none the capsule."""
    found = geometry_of(part.capsule for part in parts)
    for one, part in zip(found.geometryObjects, parts, strict=True):
        if len(part.corners):
            one.geometry, one.placement = convex(part.corners), pin.SE3.Identity()
    return found


def _adjacent(model: pin.Model, solids: pin.GeometryModel) -> list[Exclusion]:
    """Shapes of neighbouring joints that touch in some posture."""
    pairs = _pairs(solids, lambda apart: apart == 1)
    if not pairs:
        return []
    counts = contacts(model, solids, pairs, postures(model, NEIGHBOURS)).sum(axis=0)
    names = [shape.name for shape in solids.geometryObjects]
    return [
        Exclusion(names[i], names[j], Evidence.ADJACENT, int(count), NEIGHBOURS, NEIGHBOURS)
        for (i, j), count in zip(pairs, counts, strict=True)
        if count
    ]


def watched_pairs(solids: pin.GeometryModel) -> list[tuple[int, int]]:
    """Indices of shapes whose joints are two or more apart."""
    return _pairs(solids, lambda apart: apart > 1)


def _pairs(solids: pin.GeometryModel, wanted: Callable[[int], bool]) -> list[tuple[int, int]]:
    joints = [shape.parentJoint for shape in solids.geometryObjects]
    both = combinations(range(len(joints)), 2)
    return [(i, j) for i, j in both if wanted(abs(joints[i] - joints[j]))]


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
