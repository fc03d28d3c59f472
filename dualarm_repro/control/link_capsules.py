"""Fewer and wider capsules for an arm: drop the contained ones, widen or replace others."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
import pinocchio as pin

from ..arguments import Cloud, Joints, Number, Vector3, checked
from ..arms.arm import Arm
from ..arms.capsules import LinkCapsule, capsule_ends, geometry_of, not_contained, to_segment
from ..errors import InputError


@checked
def with_capsules(
    arm: Arm,
    *,
    widened: Mapping[str, float] | None = None,
    dropped: Collection[str] = (),
    added: Collection[tuple[str, int, Vector3, Vector3, float]] = (),
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
        kept = [g for g in arm.geometry.geometryObjects if g.name not in dropped]
        sizes = [widened.get(g.name, g.geometry.radius) for g in kept]
        ends = [capsule_ends(g.placement, g.geometry) for g in kept]
        named = [(g.name, g.parentJoint) for g in kept]
        rows = [(*name, *pair, size) for name, pair, size in zip(named, ends, sizes, strict=True)]
        return geometry_of(not_contained([LinkCapsule(*row) for row in (*rows, *added)]))

    return arm.reshaped(build)


@checked
def sticking_out(arm: Arm, q: Joints, joint: Number, points: Cloud) -> float:
    """Largest distance of points of a link from the capsules of all links, negative inside [m].

    A link may be covered by the capsule of its neighbour, so that several q have to be checked.

    Parameters
    ----------
    q : (nq,) [rad]
    points : (N, 3)
        In the frame of the joint [m].
    """
    if joint > arm.nq:
        raise InputError("sticking_out", "joint", joint, f"at most {arm.nq}")
    data = arm.model.createData()
    pin.forwardKinematics(arm.model, data, arm.configurations(q))
    placed = points @ data.oMi[joint].rotation.T + data.oMi[joint].translation
    reach = np.full(len(points), np.inf)
    for g in arm.geometry.geometryObjects:
        ends = map(data.oMi[g.parentJoint].act, capsule_ends(g.placement, g.geometry))
        reach = np.minimum(reach, to_segment(placed, *ends) - g.geometry.radius)
    return float(reach.max())
