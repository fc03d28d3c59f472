"""The arms that stand in for the unnamed one."""

from __future__ import annotations

import numpy as np

from ...arms import Arm, load_arm
from ...control.link_capsules import with_capsules
from ...tracking import memo

#: Radii [m] with which the capsules contain hand and base as well.
_WIDER = {"panda_hand_0": 0.057, "panda_link0_0": 0.101}
_FINGERS = ("panda_leftfinger_0", "panda_rightfinger_0")


@memo()
def redundant_arm(robot: str, capsules: str = "widened") -> Arm:
    """One arm of seven joints with its capsules.

    The collision model of the Panda has spheres at the ends of its capsules, which are left out;
    one capsule stands for both closed fingers.
    """
    arm = load_arm(robot)
    if robot != "panda":
        return arm
    fingers = [g for g in arm.geometry.geometryObjects if g.name in _FINGERS]
    middle = np.mean([g.placement.translation for g in fingers], axis=0)
    half = np.array([0.0, 0.0, fingers[0].geometry.halfLength])
    gap = np.linalg.norm(fingers[0].placement.translation - middle)
    radius = float(gap + fingers[0].geometry.radius)
    joint = fingers[0].parentJoint
    return with_capsules(
        arm,
        widened=_WIDER if capsules == "widened" else {},
        dropped=[g.name for g in arm.geometry.geometryObjects if "finger" in g.name],
        added=[("fingers", joint, middle - half, middle + half, radius)],
    )
