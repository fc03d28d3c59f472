"""Distances of links of one arm by the convex hulls of what their capsules contain.

Two capsules and the hulls within them both give a lower bound on the distance of the shapes. Of
d = max(d_capsules, min(d_hulls, CAP)) the hulls are looked at only where d_capsules < CAP: hulls
are within capsules, so that d is continuous, and as each of its terms it changes no faster than the
bodies move.
"""

from __future__ import annotations

from collections import defaultdict
from functools import lru_cache
from typing import NamedTuple

import coal
import numpy as np

from ..arms.arm import Arm
from ..arms.capsules import capsule_ends, to_segment
from ..arms.fit.triangles import convex
from .posing import frames_of, in_link_frames
from .scene import Scene

CAP = 0.03  # hulls farther apart [m] count as this far
_GJK = 1e-6  # by how much coal may overstate a distance [m]
_FILLED = 1e-9  # by how much a hull may fail to fill its capsule [m]


class HullPair(NamedTuple):
    """Column of the pair, joints that carry its two hulls, and the hulls in the link frames."""

    column: int
    first_joint: int
    second_joint: int
    first: coal.Convex
    second: coal.Convex


@lru_cache(maxsize=64)
def hulls_of(arm: Arm) -> dict[str, tuple[int, coal.Convex]]:
    """Of capsules by name the joint and the hull in its frame as :func:`.posing.link_frames` has
    it. A capsule that is not the one fitted around its hull, such as a thicker one, has none."""
    found = {}
    for one in arm.geometry.geometryObjects:
        corners = arm.hulls.get(one.name)
        if corners is None:
            continue
        ends = capsule_ends(one.placement, one.geometry)
        if abs(to_segment(corners, *ends).max() - one.geometry.radius) <= _FILLED:
            placed = in_link_frames(arm, one.parentJoint, corners)
            found[one.name] = (one.parentJoint, convex(placed))
    return found


@lru_cache(maxsize=64)
def hull_pairs(scene: Scene) -> dict[str, list[HullPair]]:
    """Watched pairs of capsules of one arm that both have a hull, by the name of the arm."""
    hulls = {placed.name: hulls_of(placed.arm) for placed in scene.arms if placed.arm.hulls}
    found = defaultdict(list)
    for column, (a, b) in enumerate(scene.pairs.bodies):
        if a.owner == b.owner and a.owner in hulls:
            known = hulls[a.owner]
            one, other = (known.get(body.name.partition("/")[2]) for body in (a, b))
            if one and other:
                found[a.owner].append(HullPair(column, one[0], other[0], one[1], other[1]))
    return dict(found)


def refine(scene: Scene, q: np.ndarray, distance: np.ndarray, witness: np.ndarray) -> None:
    """Raise the distances (N, P) of capsules where hulls show more, and move the points and
    normals of ``witness`` (N, P, 3, 3), unless it is empty, to the hulls."""
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    for placed in scene.arms:
        pairs = hull_pairs(scene).get(placed.name)
        if not pairs:
            continue
        close = distance[:, [pair.column for pair in pairs]] < CAP
        rows = np.flatnonzero(close.any(axis=1))
        if not len(rows):
            continue
        own = q[rows, scene.columns[placed.name]].copy()
        frames = frames_of(placed.arm, placed.placement.homogeneous[:3], own)
        for n, frame in zip(rows, frames, strict=True):
            at = [coal.Transform3s(one[:, :3], one[:, 3]) for one in frame]
            for k in np.flatnonzero(close[n]):
                column, i, j, first, second = pairs[k]
                result.clear()
                gap = coal.distance(first, at[i], second, at[j], request, result) - _GJK
                if gap <= distance[n, column]:
                    continue
                distance[n, column] = value = min(gap, CAP)
                if witness.size:
                    p, normal = result.getNearestPoint1(), result.normal
                    witness[n, column] = p, p + value * normal, normal
