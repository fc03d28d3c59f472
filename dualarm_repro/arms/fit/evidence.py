"""Which pairs say nothing about self-collision: judged by the exact shapes in sampled postures.

The rule for shapes is that of the default self-collision matrix of MoveIt (I. A. Sucan and
S. Chitta): pairs that are adjacent, or touch always, or never, are left out. "Never" is judged of
two capsules and what they contain of the shapes: the capsules have to overlap in many of the
postures, and their contents must not come near each other in any. A pair whose contents were seen
in contact is never left out, and its capsules overlap whenever the contents do.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

import coal
import numpy as np
import pinocchio as pin

from ..capsules import geometry_of
from ..exclusions import Evidence, Exclusion, shape_of
from .parts import Part
from .postures import contacts, home_pose, postures, usual_range
from .triangles import convex

SAMPLES = 2000  # postures of the whole arm
CLOSER = 1000  # postures of one pair, about those in which its parts overlap
SPREAD = 0.12  # standard deviation of these, as share of a joint's range of at most one turn
WORTH_IT = 5  # of them, in which parts have to overlap for it to be asked whether they ever meet
FLAGGED = 20  # postures in which they have to overlap before "never" counts
MOST = 0.5  # share of postures in which a pair touches that touches at the home pose for good
NEAR = 5e-4  # contents are near each other at this distance [m]


def judge(model: pin.Model, solids: pin.GeometryModel, parts: Sequence[Part]) -> list[Exclusion]:
    """Pairs of shapes two or more joints apart, and of capsules of them, that are left out.

    Parameters
    ----------
    model
        Of the chain; its limits are those of the postures, a turn where they are infinite.
    solids
        The exact shapes.
    parts
        The capsules around them, with what each contains.
    """
    found = list[Exclusion]()
    pairs = watched_pairs(solids)
    if not pairs:
        return found
    q, home = postures(model, SAMPLES), home_pose(model)[np.newaxis]
    of_shape = defaultdict(list)
    for part in parts:
        of_shape[shape_of(part.capsule.name)].append(part)
    bodies = {name: _Bodies.of(own) for name, own in of_shape.items()}
    names = [shape.name for shape in solids.geometryObjects]
    middles, radii = _balls(model, solids, [of_shape[name] for name in names], q)
    for k, (i, j) in enumerate(pairs):
        apart = np.linalg.norm(middles[:, i] - middles[:, j], axis=1) > radii[i] + radii[j]
        if apart.all():
            continue
        pair = PairOfShapes(model, solids, (i, j), bodies[names[i]], bodies[names[j]])
        hits = pair.overlaps(q, ~apart)
        alarms = hits.any(axis=1)
        count = int(pair.contacts(q[alarms]).sum())
        if count == len(q) or (count > MOST * len(q) and pair.contacts(home)[0]):
            evidence = Evidence.ALWAYS if count == len(q) else Evidence.HOME
            number = int(alarms.sum())
            found.append(Exclusion(names[i], names[j], evidence, count, len(q), number))
        else:
            found += pair.never(q, hits, np.random.default_rng(k))
    return found


class _Bodies(NamedTuple):
    """The parts of one shape, the hull of each, and the hull of them all."""

    parts: list[Part]
    hulls: list[pin.GeometryObject]
    whole: pin.GeometryObject

    @classmethod
    def of(cls, parts: list[Part]) -> _Bodies:
        hulls = list(geometry_of(part.capsule for part in parts).geometryObjects)
        for one, part in zip(hulls, parts, strict=True):
            if len(part.corners):  # else the capsule
                one.geometry, one.placement = convex(part.corners), pin.SE3.Identity()
        whole = parts[0].shape.copy()
        if all(len(part.corners) for part in parts):
            corners = np.concatenate([part.corners for part in parts])
            whole.geometry, whole.placement = convex(corners), pin.SE3.Identity()
        elif len(parts) == 1:
            whole = hulls[0]
        else:
            whole.geometry, whole.placement = coal.Halfspace(), pin.SE3.Identity()
        return cls(parts, hulls, whole)


class PairOfShapes:
    """Two shapes of one arm, and every pair of a part of one and a part of the other."""

    def __init__(
        self,
        model: pin.Model,
        solids: pin.GeometryModel,
        pair: tuple[int, int],
        first: _Bodies,
        second: _Bodies,
    ) -> None:
        self._model, self._solids, self._pair = model, solids, pair
        self._parts = [(a, b) for a in first.parts for b in second.parts]
        self._hulls = _geometry([*first.hulls, *second.hulls])
        self._whole = _geometry([first.whole, second.whole])
        count = len(first.parts)
        self._rows = [(a, count + b) for a in range(count) for b in range(len(second.parts))]
        self.names = [(a.capsule.name, b.capsule.name) for a, b in self._parts]
        joints = sorted(solids.geometryObjects[k].parentJoint for k in pair)
        self._moving = slice(joints[0], joints[1])  # only these joints move one against the other

    def overlaps(self, q: np.ndarray, among: np.ndarray | None = None) -> np.ndarray:
        """Whether hulls touch, of each pair in each posture (N, C), looked at ``among`` (N,)."""
        found = np.zeros((len(q), len(self._parts)), dtype=bool)
        near = np.ones(len(q), dtype=bool) if among is None else among.copy()
        near[near] = contacts(self._model, self._whole, [(0, 1)], q[near])[:, 0]
        found[near] = contacts(self._model, self._hulls, self._rows, q[near])
        return found

    def contacts(self, q: np.ndarray, near: float = 0.0) -> np.ndarray:
        """Whether the shapes come nearer than ``near`` [m] in each posture (N,)."""
        return contacts(self._model, self._solids, [self._pair], q, near)[:, 0]

    def never(self, q: np.ndarray, hits: np.ndarray, rng: np.random.Generator) -> list[Exclusion]:
        """Pairs of capsules that overlap often, though what they contain never comes near."""
        asked = hits.sum(axis=0) >= WORTH_IT
        self._unask(q, hits, asked)
        closer = self._closer(q[hits[:, asked].any(axis=1)], rng)
        again = self.overlaps(closer)
        self._unask(closer, again, asked)
        both = np.vstack([hits, again])
        counts = both.sum(axis=0)
        return [
            Exclusion(*self.names[c], Evidence.NEVER, 0, len(both), int(counts[c]))
            for c in np.flatnonzero(asked & (counts >= FLAGGED))
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

    def _unask(self, q: np.ndarray, hits: np.ndarray, asked: np.ndarray) -> None:
        """Clear ``asked`` (C,) for parts whose contents come near in a posture in which they
        overlap."""
        data = self._model.createData()
        request = coal.CollisionRequest()
        request.security_margin = NEAR

        def near(*bodies: tuple[coal.CollisionGeometry, pin.GeometryObject]) -> bool:
            placed = []
            for geometry, shape in bodies:
                at = data.oMi[shape.parentJoint] * shape.placement
                placed += [geometry, coal.Transform3s(at.rotation, at.translation)]
            return bool(coal.collide(*placed, request, coal.CollisionResult()))

        shapes = [self._solids.geometryObjects[k] for k in self._pair]
        for posture, row in zip(q, hits, strict=True):
            if not (row & asked).any():
                continue
            pin.forwardKinematics(self._model, data, posture)
            if near(*((shape.geometry, shape) for shape in shapes)):
                for c in np.flatnonzero(row & asked):
                    asked[c] = not near(*((one.content, one.shape) for one in self._parts[c]))


def _balls(
    model: pin.Model, solids: pin.GeometryModel, parts: Sequence[Sequence[Part]], q: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Middles (N, S, 3) and radii (S,) of balls around the capsules of each shape [m]."""
    joints = [shape.parentJoint for shape in solids.geometryObjects]
    ends = [[e for part in own for e in (part.capsule.start, part.capsule.end)] for own in parts]
    middles = np.array([np.mean(own, axis=0) for own in ends])
    radii = [
        max(np.linalg.norm(e - middle) for e in own) + max(part.capsule.radius for part in among)
        for own, middle, among in zip(ends, middles, parts, strict=True)
    ]
    data, found = model.createData(), np.empty((len(q), len(joints), 3))
    for row, posture in zip(found, q, strict=True):
        pin.forwardKinematics(model, data, posture)
        turns = np.array([pose.rotation for pose in data.oMi])[joints]
        row[:] = np.einsum("sij,sj->si", turns, middles)
        row += np.array([pose.translation for pose in data.oMi])[joints]
    return found, np.array(radii)


def _geometry(shapes: Sequence[pin.GeometryObject]) -> pin.GeometryModel:
    found = pin.GeometryModel()
    for k, one in enumerate(shapes):
        made = pin.GeometryObject(f"{k}", one.parentJoint, one.placement, one.geometry)
        found.addGeometryObject(made)
    return found


def watched_pairs(solids: pin.GeometryModel) -> list[tuple[int, int]]:
    """Indices of shapes whose joints are two or more apart."""
    joints = [shape.parentJoint for shape in solids.geometryObjects]
    both = combinations(range(len(joints)), 2)
    return [(i, j) for i, j in both if abs(joints[i] - joints[j]) > 1]
