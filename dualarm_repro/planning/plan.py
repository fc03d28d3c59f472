"""A plan: the path of one arm, what acted on it step by step, and why it ended."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from ..scene.bodies import PlacedArm
from ..scene.moving import JointPath
from .arm_path import ArmPath
from .descent.certificate import Certificate
from .descent.follow_reason import FollowReason
from .descent.termination import StopReason


@dataclass(frozen=True, eq=False)
class Record:
    """What the loop of a planner leaves behind; see :class:`Plan`."""

    path: np.ndarray
    attractive: np.ndarray
    repulsive: np.ndarray
    virtual: np.ndarray
    clearance: np.ndarray
    active: np.ndarray
    reason: StopReason | FollowReason
    activations: int
    arrivals: int
    wall_time: float


@dataclass(frozen=True, eq=False)
class Plan(Record, ArmPath):
    """Result of a planner; row s belongs to step s, N = steps + 1 rows.

    Attributes
    ----------
    placed : PlacedArm
    goal : ndarray (nq,)
        [rad]
    path : ndarray (N, nq)
        [rad]
    attractive : ndarray (N,)
        Potential of the goal, also while a virtual point replaces it.
    repulsive : ndarray (N, K)
        Potential of each control point.
    virtual : ndarray (N,)
        Potential of the virtual point, zero while it does not act.
    clearance : ndarray (N, K)
        Smallest signed distance of each control point to the obstacles [m]; infinite without any.
    active : ndarray (N,) of bool
        Whether the virtual point acted in the step taken from here.
    point_names, obstacle_names : tuple of str
        Of the control points and of the shapes the planner knew.
    reason : StopReason or FollowReason
    certificate : Certificate or None
        None if the goal is reached.
    activations, arrivals : int
        How often a virtual point was switched on, and how often the arm came to it.
    rescued : bool
        Whether the goal was reached after a virtual point had been switched on in a trap.
    outside_limits : tuple of str
        Which of ``start``, ``goal`` and ``path`` leave the joint limits.
    wall_time : float
        Of planning [s].
    """

    placed: PlacedArm
    goal: np.ndarray
    point_names: tuple[str, ...]
    obstacle_names: tuple[str, ...]
    certificate: Certificate | None
    rescued: bool
    outside_limits: tuple[str, ...]

    @property
    def reached(self) -> bool:
        """Whether the goal is reached."""
        return self.reason is StopReason.REACHED

    @property
    def total(self) -> np.ndarray:
        """Sum of the potentials (N,)."""
        return self.attractive + self.repulsive.sum(axis=1) + self.virtual

    def joint_path(self) -> JointPath:
        """The path over the step, to be replayed by a moving arm."""
        return JointPath(self.path)

    def to_frame(self) -> pd.DataFrame:
        """One row per step: joints q1 ... [rad], flange x, y, z [m], potentials, clearances [m]."""
        columns = self.columns()
        columns |= {"attractive": self.attractive, "virtual": self.virtual, "active": self.active}
        for k, name in enumerate(self.point_names):
            columns[f"repulsive {name}"] = self.repulsive[:, k]
            columns[f"clearance {name}"] = self.clearance[:, k]
        return pd.DataFrame(columns).rename_axis("step")
