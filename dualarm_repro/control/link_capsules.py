"""Fewer and wider capsules for an arm: drop the contained ones, widen or replace others."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
import pinocchio as pin

from ..arms.arm import Arm
from ..arms.capsules import segment_capsule

_INSIDE = 1e-4  # [m] a capsule that sticks out by less is left out


def with_capsules(
    arm: Arm,
    *,
    widened: Mapping[str, float] | None = None,
    dropped: Collection[str] = (),
    added: Collection[tuple[str, int, np.ndarray, np.ndarray, float]] = (),
) -> Arm:
    """The arm with other capsules; those that lie inside another one of their link are left out.

    Parameters
    ----------
    widened : mapping of name to radius [m]
    dropped : names
    added : (name, joint, start, end, radius)
        In the frame of the joint [m].
    """
    widened = dict(widened or {})

    def build() -> pin.GeometryModel:
        shapes = [
            (g.name, g.parentJoint, *_ends(g), widened.get(g.name, g.geometry.radius))
            for g in arm.geometry.geometryObjects
            if g.name not in dropped
        ]
        shapes += added
        geometry = pin.GeometryModel()
        for k, (name, joint, start, end, radius) in enumerate(shapes):
            others = shapes[:k] + shapes[k + 1 :]
            if any(_contains(o, shapes[k]) for o in others if o[1] == joint):
                continue
            placement, capsule = segment_capsule(start, end, radius)
            geometry.addGeometryObject(pin.GeometryObject(name, joint, placement, capsule))
        return geometry

    flange = arm.model.frames[arm.flange_id].name
    return Arm(arm.name, arm.title, arm.model, flange, build)


def sticking_out(arm: Arm, q: np.ndarray, joint: int, points: np.ndarray) -> float:
    """Largest distance of points of a link from the capsules of all links, negative inside [m].

    A link may be covered by the capsule of its neighbour, so that several q have to be checked.

    Parameters
    ----------
    q : (nq,) [rad]
    points : (N, 3)
        In the frame of the joint [m].
    """
    data = arm.model.createData()
    pin.forwardKinematics(arm.model, data, q)
    placed = points @ data.oMi[joint].rotation.T + data.oMi[joint].translation
    reach = np.full(len(points), np.inf)
    for g in arm.geometry.geometryObjects:
        start, end = (data.oMi[g.parentJoint].act(end) for end in _ends(g))
        reach = np.minimum(reach, _to_segment(placed, start, end) - g.geometry.radius)
    return float(reach.max())


def _ends(g: pin.GeometryObject) -> tuple[np.ndarray, np.ndarray]:
    half = g.geometry.halfLength
    return tuple(g.placement.act(np.array([0.0, 0.0, sign * half])) for sign in (-1.0, 1.0))


def _to_segment(points: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    along = end - start
    square = along @ along
    share = ((points - start) @ along / square).clip(0.0, 1.0) if square else np.zeros(len(points))
    return np.linalg.norm(points - start - share[:, None] * along, axis=1)


def _contains(outer: tuple, inner: tuple) -> bool:
    """Whether a capsule lies inside a longer or thicker one."""
    _, _, start, end, radius = outer
    reach = _to_segment(np.array([inner[2], inner[3]]), start, end).max() + inner[4]
    longer = np.linalg.norm(inner[3] - inner[2]) < np.linalg.norm(end - start)
    return reach <= radius + _INSIDE and (inner[4] < radius or longer)
