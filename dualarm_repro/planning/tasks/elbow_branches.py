"""Postures of an elbow arm with its flange at a point and given wrist angles, by branch.

With all joints zero the upper arm a2 stands on the shoulder, d1 over the base, and the forearm d4
lies ahead of it, a3 over the elbow; the wrist is spherical and the flange d6 in front of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from ...arms import Arm
from ...errors import UnsupportedArmError
from ...scene import PlacedArm

BRANCHES = ("front_shallow", "front_deep", "back_shallow", "back_deep")
NO_BEND = (0.0, 0.0, 0.0)


class ElbowLengths(NamedTuple):
    """Link lengths and offsets of the standard table [m]; a tool makes d6 longer."""

    d1: float
    a2: float
    a3: float
    d4: float
    d6: float


def elbow_lengths(arm: Arm) -> ElbowLengths:
    """The lengths of an arm.

    Raises
    ------
    UnsupportedArmError
        Not six joints, or joints that are offset in another way.
    """
    between = arm.chain.translation
    if len(between) == 7:
        found = ElbowLengths(
            between[1, 2], between[2, 0], between[3, 0], between[4, 2], between[6, 2]
        )
        d1, a2, a3, d4, d6 = map(float, found)
        steps = [(0, 0, 0), (0, 0, d1), (a2, 0, 0), (a3, 0, 0), (0, 0, d4), (0, 0, 0), (0, 0, d6)]
        if np.allclose(between, steps, rtol=0.0, atol=1e-12):
            return ElbowLengths(d1, a2, a3, d4, d6)
    raise UnsupportedArmError(
        f"arm {arm.name}: not an elbow arm with the lengths d1, a2, a3, d4, d6"
    )


def shoulder(placed: PlacedArm) -> np.ndarray:
    """Where axes 1 and 2 cross, in the world (3,) [m]."""
    return placed.placement.act(np.array([0.0, 0.0, elbow_lengths(placed.arm).d1]))


def straight_reach(arm: Arm) -> float:
    """Largest distance of the flange from the shoulder: the straight arm [m]."""
    size = elbow_lengths(arm)
    return size.a2 + float(np.hypot(size.d4, size.a3)) + size.d6


def wrist_reach(arm: Arm, wrist: Sequence[float]) -> float:
    """Largest distance of the flange from the shoulder with given wrist angles (3,) [m]."""
    outer, _, aside = _outer_link(elbow_lengths(arm), wrist)
    return float(np.hypot(elbow_lengths(arm).a2 + outer, aside))


def pulled_back(placed: PlacedArm, point: np.ndarray, radius: float) -> np.ndarray:
    """The point moved along the ray from the shoulder to a distance from it (3,) [m]."""
    ray = point - shoulder(placed)
    return shoulder(placed) + radius * ray / np.linalg.norm(ray)


def branch_posture(
    placed: PlacedArm, point: np.ndarray, branch: str, wrist: Sequence[float] = NO_BEND
) -> np.ndarray | None:
    """q (6,) with the flange at a point and given wrist angles, on a named branch; None beyond
    reach.

    The arm, upright, is a chain of two links in a vertical plane: the upper arm, and forearm and
    wrist as one, whose flange a rolled wrist puts ``aside`` of the plane. ``front`` faces the
    point, ``back`` reaches over the shoulder; ``deep`` bends the elbow the other way than
    ``shallow``. Joint limits are not looked at.
    """
    size = elbow_lengths(placed.arm)
    outer, lag, aside = _outer_link(size, wrist)
    yaw = pin.rpy.matrixToRpy(placed.placement.rotation)[2]
    x, y, z = point - shoulder(placed)
    flat = x**2 + y**2 - aside**2
    if flat < 0.0:
        return None
    radius = -np.sqrt(flat) if branch.startswith("back") else np.sqrt(flat)
    square = radius**2 + z**2
    cosine = (square - size.a2**2 - outer**2) / (2.0 * size.a2 * outer)
    if abs(cosine) > 1.0:
        return None
    fold = np.arccos(cosine) * (1.0 if branch.endswith("deep") else -1.0)
    lift = np.arctan2(z, radius) - np.arctan2(outer * np.sin(fold), size.a2 + outer * np.cos(fold))
    upper = np.pi / 2 - lift
    turn = np.arctan2(y, x) - np.arctan2(aside, radius) - yaw
    q = np.array([turn, upper, lag - lift - fold - upper, *wrist])
    q[:3] = (q[:3] + np.pi) % (2.0 * np.pi) - np.pi
    return q


def _outer_link(size: ElbowLengths, wrist: Sequence[float]) -> tuple[float, float, float]:
    """Forearm and wrist as one link: its length in the plane of the upper arm [m], its angle to
    the forearm [rad], and how far the flange is beside the plane [m]."""
    roll, bend, _ = wrist
    along = size.d4 + size.d6 * np.cos(bend)
    across = size.a3 - size.d6 * np.sin(bend) * np.cos(roll)
    aside = size.d6 * np.sin(bend) * np.sin(roll)
    return float(np.hypot(along, across)), float(np.arctan2(across, along)), float(aside)
