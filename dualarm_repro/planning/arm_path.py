"""What the path of one arm says about itself, whichever planner found it."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .field.control_points import end_effector

if TYPE_CHECKING:
    from ..scene import PlacedArm


class ArmPath:
    """A joint path of a placed arm; base of every plan.

    Attributes
    ----------
    placed : PlacedArm
    path : ndarray (N, nq)
        [rad]
    """

    placed: PlacedArm
    path: np.ndarray

    @property
    def steps(self) -> int:
        """Number of joint steps."""
        return len(self.path) - 1

    @cached_property
    def tcp(self) -> np.ndarray:
        """X, the flange in the world (N, 3) [m]."""
        return end_effector(self.placed, self.path)

    @property
    def length(self) -> float:
        """Length of the path in joint space, sum |dq| [rad]."""
        return float(np.linalg.norm(np.diff(self.path, axis=0), axis=1).sum())

    @property
    def tcp_length(self) -> float:
        """Length of the path of the flange [m]."""
        return float(np.linalg.norm(np.diff(self.tcp, axis=0), axis=1).sum())

    def columns(self) -> dict[str, np.ndarray]:
        """Joints q1 ... [rad] and flange x, y, z [m], each (N,)."""
        joints = {f"q{j + 1}": angle for j, angle in enumerate(self.path.T)}
        return joints | dict(zip("xyz", self.tcp.T, strict=True))
