"""Link frames of a table, and the flange by other tables of the same arm."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
import pinocchio as pin

from .arm import Arm
from .dh import joint_symbols
from .joint_axes import common_origins


def frames_at_zero(arm: Arm) -> np.ndarray:
    """Base frame and the frames of the table with all joints zero (n + 1, 4, 4)."""
    zero = dict.fromkeys(joint_symbols(arm.nq), 0)
    frames = [np.eye(4)]
    for transform in arm.link_transforms():
        frames.append(frames[-1] @ np.array(transform.subs(zero).evalf(), dtype=float))
    return np.array(frames)


def coinciding(frames: np.ndarray) -> list[list[int]]:
    """Pairs of frames (N, 4, 4), numbered from 1, whose origins are one point."""
    groups = common_origins(frames)
    return [[a + 1, b + 1] for group in groups for a, b in combinations(group, 2)]


def offset_chain(steps: Sequence[tuple[tuple[float, float, float], str]], q: np.ndarray) -> pin.SE3:
    """Pose after offsets (3,) [m], each followed by a turn about the axis x, y or z by an angle of
    q (n,) [rad], as a robot description gives them."""
    pose = pin.SE3.Identity()
    for angle, (offset, axis) in zip(q, steps, strict=True):
        pose = pose * pin.SE3(pin.utils.rotate(axis, float(angle)), np.array(offset))
    return pose


def modified_chain(rows: Sequence[tuple[float, float, float, float]]) -> pin.SE3:
    """Pose by rows (alpha, a, d, theta) of a modified table: Rx(alpha) Tx(a) Rz(theta) Tz(d)."""
    pose = pin.SE3.Identity()
    for alpha, a, d, theta in rows:
        turn = pin.utils.rotate("z", theta)
        pose = pose * pin.SE3(pin.utils.rotate("x", alpha), np.array([a, 0.0, 0.0]))
        pose = pose * pin.SE3(turn, np.array([0.0, 0.0, d]))
    return pose
