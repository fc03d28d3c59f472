"""Distances of links of one arm by the shapes of its robot file, where capsules and hulls overlap.

Concave shapes nest in each other, and their hulls overlap though they are apart. The third term of
d = max(d_capsules, min(d_hulls, CAP), min(d_shapes, NEAR)) is asked where the first two are below
NEAR. The distance of the shapes is never more than that of what two of their capsules contain; if
they touch, the first two terms stand. As long as nothing touches, d is continuous and changes no
faster than the shapes move.

It is asked of arms whose pairs were judged by their exact shapes
(:attr:`..arms.arm.Arm.exclusions`), and of capsules that still are as they were fitted around them.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import NamedTuple

import coal
import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from ..arms.exclusions import shape_of
from ..tracking import kept_with_owner
from . import hull_pairs
from .hull_pairs import GJK, Carried, places, transform
from .posing import frames_of, in_link_frames
from .scene import Scene

NEAR = 0.01  # shapes farther apart [m] count as this far
_ROUND = (coal.Sphere, coal.Capsule)  # which are the capsules around them


class ShapePair(NamedTuple):
    """Columns of the pairs of capsules around two shapes, and the two."""

    columns: list[int]
    first: Carried
    second: Carried


def refine(scene: Scene, q: np.ndarray, distance: np.ndarray, witness: np.ndarray) -> None:
    """Raise the distances (N, P) of capsules of one arm where hulls or exact shapes show more, and
    move the points and normals of ``witness`` (N, P, 3, 3), unless it is empty, to these."""
    hull_pairs.refine(scene, q, distance, witness)
    known = shape_pairs(scene)
    if not known:
        return
    for placed in scene.arms:
        pairs = known.get(placed.name)
        if not pairs:
            continue
        columns = [column for pair in pairs for column in pair.columns]
        starts = np.cumsum([0, *(len(pair.columns) for pair in pairs[:-1])])
        close = np.minimum.reduceat(distance[:, columns], starts, axis=1) < NEAR
        rows = np.flatnonzero(close.any(axis=1))
        if not len(rows):
            continue
        own = q[rows, scene.columns[placed.name]].copy()
        frames = frames_of(placed.arm, placed.placement.homogeneous[:3], own)
        for n, frame in zip(rows, frames, strict=True):
            joints = places(frame)
            for k in np.flatnonzero(close[n]):
                _raise(pairs[k], joints, distance[n], witness[n] if witness.size else None)


def _raise(
    pair: ShapePair,
    joints: Sequence[coal.Transform3s],
    distance: np.ndarray,
    witness: np.ndarray | None,
) -> None:
    """The same for one pair of shapes in one posture, with the places of its joints."""
    result = coal.DistanceResult()
    if witness is None:
        result.min_distance = 2.0 * NEAR  # what is farther is not searched through
    at = pair.first.placed(joints), pair.second.placed(joints)
    bodies = pair.first.geometry, at[0], pair.second.geometry, at[1]
    gap = min(coal.distance(*bodies, coal.DistanceRequest(), result), result.min_distance) - GJK
    if gap <= 0.0:
        return
    value = min(gap, NEAR)
    for column in pair.columns:
        if distance[column] < value:
            distance[column] = value
            if witness is not None:
                p = result.getNearestPoint1()
                normal = (result.getNearestPoint2() - p) / (gap + GJK)
                witness[column] = p, p + value * normal, normal


@kept_with_owner
def shape_pairs(scene: Scene) -> dict[str, list[ShapePair]]:
    """Pairs of shapes of which capsules are watched against each other, by the name of the arm."""
    shapes = {placed.name: shapes_of(placed.arm) for placed in scene.arms}
    found: dict[str, dict[tuple[str, str], ShapePair]] = defaultdict(dict)
    for column, (a, b) in enumerate(scene.pairs.bodies):
        known = shapes.get(a.owner)
        if a.owner != b.owner or not known:
            continue
        names = [body.name.partition("/")[2] for body in (a, b)]
        first, second = map(known.get, names)
        if first is None or second is None:
            continue
        if not (isinstance(first.geometry, _ROUND) and isinstance(second.geometry, _ROUND)):
            key = shape_of(names[0]), shape_of(names[1])
            found[a.owner].setdefault(key, ShapePair([], first, second)).columns.append(column)
    return {owner: list(pairs.values()) for owner, pairs in found.items()}


@kept_with_owner
def shapes_of(arm: Arm) -> dict[str, Carried]:
    """Of capsules by name the exact shape in which they are, in the frame of their joint as
    :func:`.posing.link_frames` has it; of those that are as they were fitted around it."""
    if arm.fit is None or arm.solids is None:
        return {}
    fitted = {one.name: one for one in arm.fit.geometryObjects}
    solids = {one.name: one for one in arm.solids.geometryObjects}
    carried = {
        name: Carried(one.parentJoint, one.geometry, transform(_in_link_frame(arm, one)))
        for name, one in solids.items()
    }
    return {
        one.name: carried[shape_of(one.name)]
        for one in arm.geometry.geometryObjects
        if one.name in fitted and _same(one, fitted[one.name]) and shape_of(one.name) in carried
    }


def _same(one: pin.GeometryObject, other: pin.GeometryObject) -> bool:
    return bool(one.geometry == other.geometry and one.placement == other.placement)


def _in_link_frame(arm: Arm, shape: pin.GeometryObject) -> pin.SE3:
    at = shape.placement
    points = np.vstack([at.translation, at.translation + at.rotation.T])
    origin, *axes = in_link_frames(arm, shape.parentJoint, points)
    return pin.SE3(np.column_stack([axis - origin for axis in axes]), origin)
