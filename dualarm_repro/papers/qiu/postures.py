"""Postures of the arm that take the flange to a point with given wrist angles, by branch."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pinocchio as pin

from ...scene import PlacedArm
from .document import lengths, shoulder

BRANCHES = ("front_shallow", "front_deep", "back_shallow", "back_deep")


def branch_posture(
    arm: PlacedArm, point: np.ndarray, branch: str, wrist: Sequence[float] = (0.0, 0.0, 0.0)
) -> np.ndarray | None:
    """q (6,) with the flange at a point and given wrist angles, on a named branch; None beyond
    reach.

    The arm is a chain of two links in a vertical plane: the upper arm, and forearm and wrist as
    one, whose flange a rolled wrist puts ``aside`` of the plane. ``front`` faces the point,
    ``back`` reaches over the shoulder; ``deep`` bends the elbow the other way than ``shallow``.
    """
    upper_arm = lengths()["a2"]
    outer, lag, aside = _outer_link(arm, wrist)
    yaw = pin.rpy.matrixToRpy(arm.placement.rotation)[2]
    x, y, z = point - shoulder(arm.placement.translation)
    flat = x**2 + y**2 - aside**2
    if flat < 0.0:
        return None
    radius = -np.sqrt(flat) if branch.startswith("back") else np.sqrt(flat)
    square = radius**2 + z**2
    cosine = (square - upper_arm**2 - outer**2) / (2.0 * upper_arm * outer)
    if abs(cosine) > 1.0:
        return None
    fold = np.arccos(cosine) * (1.0 if branch.endswith("deep") else -1.0)
    lift = np.arctan2(z, radius) - np.arctan2(
        outer * np.sin(fold), upper_arm + outer * np.cos(fold)
    )
    upper = np.pi / 2 - lift
    turn = np.arctan2(y, x) - np.arctan2(aside, radius) - yaw
    q = np.array([turn, upper, lag - lift - fold - upper, *wrist])
    q[:3] = (q[:3] + np.pi) % (2.0 * np.pi) - np.pi
    return q


def _outer_link(arm: PlacedArm, wrist: Sequence[float]) -> tuple[float, float, float]:
    """Forearm and wrist as one link: its length in the plane of the upper arm [m], its angle to
    the forearm [rad], and how far the flange is beside the plane [m]."""
    size, (roll, bend, _) = lengths(), wrist
    tool = float(np.linalg.norm(arm.arm.chain.translation[-1]))
    along = size["d4"] + tool * np.cos(bend)
    across = size["a3"] - tool * np.sin(bend) * np.cos(roll)
    aside = tool * np.sin(bend) * np.sin(roll)
    return float(np.hypot(along, across)), float(np.arctan2(across, along)), float(aside)


def wrist_reach(arm: PlacedArm, wrist: Sequence[float]) -> float:
    """Largest distance of the flange from the shoulder with given wrist angles [m]."""
    outer, _, aside = _outer_link(arm, wrist)
    return float(np.hypot(lengths()["a2"] + outer, aside))


def pulled_back(point: np.ndarray, base: np.ndarray, radius: float) -> np.ndarray:
    """The point moved along the ray from the shoulder to a distance from it (3,) [m]."""
    ray = point - shoulder(base)
    return shoulder(base) + radius * ray / np.linalg.norm(ray)
