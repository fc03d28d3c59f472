"""Shape of an arm: slender links, barrels on the joint axes, a foot, a flange and its tool.

What is drawn of a link lies within the capsule that is checked for it, so that no contact is seen
that the computation does not know.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pinocchio as pin

from ...arms import Arm
from .contents import Part

#: Radii of a link at its two ends, as shares of its capsule's.
_NEAR, _FAR = 0.78, 0.62
#: Radius and half height of a barrel; their corner lies on the sphere of the capsule.
_BARREL, _HALF = 0.80, 0.60
_DARK, _LIGHT = 0.42, 0.12
FOOT = "#8A9299"


def arm_parts(name: str, arm: Arm, color: str, opacity: float, base: str) -> Iterator[Part]:
    """Parts of an arm, whose node of joint k is ``name/k`` and that of its base ``base``."""
    nodes = {0: base} | {k: f"{name}/{k}" for k in range(1, arm.model.njoints)}
    dark, light = mixed(color, "#20262C", _DARK), mixed(color, "#FFFFFF", _LIGHT)
    capsules = list(arm.geometry.geometryObjects)
    for capsule in capsules:
        node, body = nodes[capsule.parentJoint], f"{name}:{capsule.parentJoint}"
        if capsule.name.startswith("tool_"):
            yield from _tool(node, capsule, body, opacity, first=capsule.name == "tool_0")
            continue
        radius, length = capsule.geometry.radius, 2.0 * capsule.geometry.halfLength
        size = (_NEAR * radius, _FAR * radius, length)
        pose = capsule.placement.homogeneous
        yield Part(node, "tapered", size, light, pose, opacity, body)
    for joint in range(1, arm.model.njoints):
        room = _room(arm, capsules, joint)
        if room is None:
            continue
        carrier, place, radius = room
        barrel = (_BARREL * radius, 2.0 * _HALF * radius)
        yield Part(nodes[carrier], "rod", barrel, dark, place, opacity, f"{name}:{carrier}")
    flange = arm.model.frames[arm.flange_id]
    last = [c.geometry.radius for c in capsules if c.parentJoint == flange.parentJoint]
    if last and opacity == 1.0:
        thick = 0.25 * min(last)
        place = flange.placement * pin.SE3(np.eye(3), np.array([0.0, 0.0, -0.5 * thick]))
        disc = (0.62 * min(last), thick)
        yield Part(nodes[flange.parentJoint], "rod", disc, FOOT, place.homogeneous, opacity)


def checked_parts(name: str, arm: Arm, color: str, base: str) -> Iterator[Part]:
    """The capsules of an arm as they are checked."""
    for capsule in arm.geometry.geometryObjects:
        shape, joint = capsule.geometry, capsule.parentJoint
        size = (shape.radius, shape.radius, 2.0 * shape.halfLength)
        node = f"{name}/{joint}" if joint else base
        pose = capsule.placement.homogeneous
        yield Part(node, "tapered", size, color, pose, 0.25, f"{name}:{joint}")


def foot(arm: Arm) -> tuple[float, float] | None:
    """Height in the frame of the base at which an arm begins, and the radius it has there [m]."""
    neutral = _lowest(arm)
    if neutral is None:
        return None
    low, radius = neutral
    return (0.0 if low > -0.25 * radius else low), radius


def mixed(color: str, other: str, share: float) -> str:
    """A ``#rrggbb`` colour with a share of another."""
    pairs = zip(bytes.fromhex(color[1:]), bytes.fromhex(other[1:]), strict=True)
    return "#" + "".join(f"{round((1 - share) * a + share * b):02X}" for a, b in pairs)


def joint_axis(arm: Arm, joint: int) -> np.ndarray:
    """Unit axis (3,) about which a joint turns, or along which it slides, in its own frame."""
    data = arm.model.createData()
    pin.computeJointJacobians(arm.model, data, pin.neutral(arm.model))
    twist = data.J.reshape(6, arm.nq)[:, arm.model.idx_vs[joint]]  # Pinocchio drops a single axis
    axis = data.oMi[joint].rotation.T @ (twist[3:] if twist[3:].any() else twist[:3])
    return axis / np.linalg.norm(axis)


def _room(arm: Arm, capsules: list[Any], joint: int) -> tuple[int, np.ndarray, float] | None:
    """Joint that carries the barrel of a joint, its pose there and the radius left for it."""
    parent = arm.model.parents[joint]
    onto = arm.model.jointPlacements[joint]
    best = None
    for capsule in capsules:
        carrier = capsule.parentJoint
        if carrier not in (joint, parent) or capsule.name.startswith("tool_"):
            continue
        origin = np.zeros(3) if carrier == joint else onto.translation
        local = capsule.placement.actInv(origin)
        along = np.clip(local[2], -capsule.geometry.halfLength, capsule.geometry.halfLength)
        gap = float(np.linalg.norm(local - [0.0, 0.0, along]))
        left = capsule.geometry.radius - gap
        if left > 0.4 * capsule.geometry.radius and (best is None or left > best[2]):
            frame = pin.SE3.Identity() if carrier == joint else onto
            best = (carrier, frame, left)
    if best is None:
        return None
    carrier, frame, left = best
    turn = pin.Quaternion.FromTwoVectors(np.array([0.0, 0.0, 1.0]), joint_axis(arm, joint))
    return carrier, (frame * pin.SE3(turn.matrix(), np.zeros(3))).homogeneous, left


def _tool(node: str, capsule: Any, body: str, opacity: float, first: bool) -> Iterator[Part]:
    """A slim rod with a collar at the flange."""
    radius, length = capsule.geometry.radius, 2.0 * capsule.geometry.halfLength
    pose = capsule.placement
    yield Part(
        node, "tapered", (0.55 * radius, 0.4 * radius, length), "#3B434A", pose.homogeneous,
        opacity, body,
    )  # fmt: skip
    if first:
        at = pose * pin.SE3(np.eye(3), np.array([0.0, 0.0, 0.2 * radius - 0.5 * length]))
        size = (0.85 * radius, 0.4 * radius)
        yield Part(node, "rod", size, FOOT, at.homogeneous, opacity, body)


def _lowest(arm: Arm) -> tuple[float, float] | None:
    data = arm.model.createData()
    pin.forwardKinematics(arm.model, data, pin.neutral(arm.model))
    found = []
    for capsule in arm.geometry.geometryObjects:
        if capsule.parentJoint <= 1:
            pose = data.oMi[capsule.parentJoint] * capsule.placement
            for side in (-1.0, 1.0):
                end = pose.act(np.array([0.0, 0.0, side * capsule.geometry.halfLength]))
                radius = capsule.geometry.radius
                if np.hypot(*end[:2]) < 0.5 * radius:
                    found.append((float(end[2] - radius), float(radius)))
    return min(found, default=None)
