"""Distances of the exact shapes of arms along a motion: a check that knows no capsule and no hull.

Every shape of one arm against every shape of another, and of one arm the shapes two or more joints
apart that are not left out (:attr:`...arms.arm.Arm.exclusions`) and the neighbours that count
(:attr:`...arms.arm.Arm.neighbours`), all by coal on what the files say.
Two shapes some parts of which are left out, since these never meet, count where they touch.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import coal
import numpy as np
import pinocchio as pin

from ...arms.exclusions import Evidence, shape_of
from ...errors import UnsupportedArmError
from ...scene import PlacedArm, Scene


@dataclass(frozen=True, eq=False)
class _Solid:
    owner: int
    name: str
    joint: int
    placement: pin.SE3
    geometry: coal.CollisionGeometry
    middle: np.ndarray
    radius: float


def mesh_distance(scene: Scene, path: np.ndarray) -> float:
    """Smallest distance of the exact shapes of all controlled arms over the rows of a path (N, nq)
    [m]: what touches counts as 0, what is not watched as infinitely far.

    Raises
    ------
    UnsupportedArmError
        An arm whose exact shapes are not known.
    """
    solids = [one for k, placed in enumerate(scene.arms) for one in _solids(k, placed)]
    pairs = list(_watched(scene, solids))
    parts = [_left_out(placed, part=True) for placed in scene.arms]
    least = np.inf
    for q in np.atleast_2d(path):
        poses = _poses(scene, solids, q)
        middles = np.array([pose.act(one.middle) for pose, one in zip(poses, solids, strict=True)])
        gaps = [
            float(np.linalg.norm(middles[a] - middles[b])) - solids[a].radius - solids[b].radius
            for a, b in pairs
        ]
        for k in np.argsort(gaps):
            if gaps[k] >= least:
                break
            a, b = pairs[k]
            gap, names = _distance(solids, poses, a, b), frozenset((solids[a].name, solids[b].name))
            near = solids[a].owner == solids[b].owner and names in parts[solids[a].owner]
            if gap <= 0.0 or not near:
                least = min(least, gap)
    return least


def _distance(solids: list[_Solid], poses: list[pin.SE3], a: int, b: int) -> float:
    placed = []
    for k in (a, b):
        at = coal.Transform3s(poses[k].rotation, poses[k].translation)
        placed += [solids[k].geometry, at]
    found = coal.distance(*placed, coal.DistanceRequest(), coal.DistanceResult())
    return max(float(found), 0.0)


def _solids(owner: int, placed: PlacedArm) -> Iterator[_Solid]:
    if placed.arm.solids is None:
        raise UnsupportedArmError(f"arm {placed.arm.name}: its exact shapes are not known")
    for shape in placed.arm.solids.geometryObjects:
        solid = shape.geometry
        solid.computeLocalAABB()
        middle, radius = np.array(solid.aabb_center), float(solid.aabb_radius)
        yield _Solid(owner, shape.name, shape.parentJoint, shape.placement, solid, middle, radius)


def _poses(scene: Scene, solids: list[_Solid], q: np.ndarray) -> list[pin.SE3]:
    found = []
    for placed in scene.arms:
        data = placed.arm.model.createData()
        pin.forwardKinematics(placed.arm.model, data, q[scene.columns[placed.name]])
        found.append([placed.placement * pose for pose in data.oMi])
    return [found[one.owner][one.joint] * one.placement for one in solids]


def _left_out(placed: PlacedArm, part: bool) -> set[frozenset[str]]:
    """Pairs of shapes that are left out, or (``part``) some parts of which are."""
    shapes = {solid.name for solid in (placed.arm.solids or pin.GeometryModel()).geometryObjects}
    found = set()
    for one in placed.arm.exclusions or ():
        names = frozenset((one.first, one.second))
        if (names <= shapes and one.evidence is not Evidence.NEVER) != part:
            found.add(frozenset(name if name in shapes else shape_of(name) for name in names))
    return found


def _watched(scene: Scene, solids: list[_Solid]) -> Iterator[tuple[int, int]]:
    silent = [_left_out(placed, part=False) for placed in scene.arms]
    near = [{frozenset((n.first, n.second)) for n in one.arm.neighbours} for one in scene.arms]
    for a, b in combinations(range(len(solids)), 2):
        one, other = solids[a], solids[b]
        if one.owner != other.owner:
            if one.joint or other.joint:
                yield a, b
            continue
        names, apart = frozenset((one.name, other.name)), abs(one.joint - other.joint)
        if names in near[one.owner] if apart == 1 else apart and names not in silent[one.owner]:
            yield a, b
