"""An arm with a longer tool, or with links of another thickness, than its robot file gives it."""

from __future__ import annotations

from collections.abc import Sequence

from .arm import Arm
from .robot_file import DHRobot, changed


def altered(name: str, robot: DHRobot, tool: float, radii: Sequence[float] | None = None) -> Arm:
    """The arm of a DH table, its flange moved out by ``tool`` [m] along the last axis and its
    capsules of other ``radii`` [m]."""
    last = changed(robot.joints[-1], d=robot.joints[-1].d + tool)
    used = [capsule.radius for capsule in robot.capsules] if radii is None else radii
    capsules = [changed(c, radius=radius) for c, radius in zip(robot.capsules, used, strict=True)]
    made = changed(robot, joints=[*robot.joints[:-1], last], capsules=capsules)
    thick = "" if radii is None else "-" + "-".join(f"{radius:g}" for radius in radii)
    return Arm.from_dh(f"{name}-{tool:g}{thick}", made)
