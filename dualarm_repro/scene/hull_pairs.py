"""Distances of links of one arm by the convex hulls of what their capsules contain.

Two capsules and the hulls within them both give a lower bound on the distance of the shapes. Of
d = max(d_capsules, min(d_hulls, CAP)) the hulls are looked at only where d_capsules < CAP, where
it is continuous, and as each of its terms it changes no faster than the
bodies move.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import NamedTuple

import coal
import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from ..arms.capsules import capsule_ends, segment_capsule, to_segment
from ..arms.fit.triangles import PRISM, convex
from ..tracking import kept_with_owner
from .posing import frames_of, in_link_frames, links_of
from .scene import Scene

CAP = 0.03  # hulls farther apart [m] count as this far
GJK = 1e-6  # by how much coal may overstate a distance [m]
_FILLED = 1e-9  # by how much a hull may fail to fill its capsule [m]


class Carried(NamedTuple):
    """A hull, or another shape at a pose, in the frame of the joint that carries it."""

    joint: int
    geometry: coal.CollisionGeometry
    pose: coal.Transform3s | None = None

    def placed(self, joints: Sequence[coal.Transform3s]) -> coal.Transform3s:
        """Where it is, for the places of the joints."""
        at = joints[self.joint]
        return at if self.pose is None else at * self.pose


def places(frames: np.ndarray) -> list[coal.Transform3s]:
    """Frames (J, 3, 4) as coal has them."""
    return [coal.Transform3s(frame[:, :3], frame[:, 3]) for frame in frames]


def transform(pose: pin.SE3) -> coal.Transform3s:
    """A pose as coal has it."""
    return coal.Transform3s(pose.rotation, pose.translation)


class HullPair(NamedTuple):
    """Column of the pair, and its two bodies."""

    column: int
    first: Carried
    second: Carried


@kept_with_owner
def hulls_of(arm: Arm) -> dict[str, Carried]:
    """Of capsules by name the hull in the frame of their joint as :func:`.posing.link_frames` has
    it. A capsule that is not the one fitted around its hull, such as a thicker one, has none."""
    found = {}
    for one in arm.geometry.geometryObjects:
        corners = arm.hulls.get(one.name)
        if corners is None:
            continue
        ends, radius = capsule_ends(one.placement, one.geometry), one.geometry.radius
        farthest = to_segment(corners, *ends).max()
        if min(abs(farthest - radius), abs(farthest - PRISM * radius)) <= _FILLED:
            local = in_link_frames(arm, one.parentJoint, corners)
            found[one.name] = Carried(one.parentJoint, convex(local))
    return found


def _capsules_of(arm: Arm) -> dict[str, Carried]:
    links, found = links_of(arm), {}
    for name, joint, core, radius in zip(*links, strict=True):
        pose, solid = segment_capsule(core[0], core[1], float(radius))
        found[name] = Carried(int(joint), solid, transform(pose))
    return found


@kept_with_owner
def hull_pairs(scene: Scene) -> dict[str, list[HullPair]]:
    """Watched pairs of capsules of one arm one of which has a hull, by the name of the arm."""
    arms = {placed.name: placed.arm for placed in scene.arms if placed.arm.hulls}
    hulls = {name: hulls_of(arm) for name, arm in arms.items()}
    known = {name: _capsules_of(arm) | hulls[name] for name, arm in arms.items()}
    found = defaultdict(list)
    for column, (a, b) in enumerate(scene.pairs.bodies):
        if a.owner == b.owner and a.owner in hulls:
            names = [body.name.partition("/")[2] for body in (a, b)]
            if any(name in hulls[a.owner] for name in names):
                found[a.owner].append(HullPair(column, *(known[a.owner][name] for name in names)))
    return dict(found)


def refine(scene: Scene, q: np.ndarray, distance: np.ndarray, witness: np.ndarray) -> None:
    """Raise the distances (N, P) of capsules where hulls show more, and move the points and
    normals of ``witness`` (N, P, 3, 3), unless it is empty, to the hulls."""
    known = hull_pairs(scene)
    if not known:
        return
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    for placed in scene.arms:
        pairs = known.get(placed.name)
        if not pairs:
            continue
        close = distance[:, [pair.column for pair in pairs]] < CAP
        rows = np.flatnonzero(close.any(axis=1))
        if not len(rows):
            continue
        own = q[rows, scene.columns[placed.name]].copy()
        frames = frames_of(placed.arm, placed.placement.homogeneous[:3], own)
        for n, frame in zip(rows, frames, strict=True):
            joints = places(frame)
            for k in np.flatnonzero(close[n]):
                column, first, second = pairs[k]
                at = first.placed(joints), second.placed(joints)
                result.clear()
                bodies = first.geometry, at[0], second.geometry, at[1]
                gap = coal.distance(*bodies, request, result) - GJK
                if gap <= distance[n, column]:
                    continue
                distance[n, column] = value = min(gap, CAP)
                if witness.size:
                    p, normal = result.getNearestPoint1(), result.normal
                    witness[n, column] = p, p + value * normal, normal
