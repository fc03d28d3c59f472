"""The planners of `xue`: improved, traditional, and attraction alone, from the assumptions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Self

import numpy as np

from ...planning.settings import (
    APFSettings,
    Attraction,
    Combination,
    Repulsion,
    Termination,
    Trap,
    Update,
    VirtualPoint,
)
from .scenario import GAINS

POSITION_TOLERANCE = 0.02  # [m] of the traditional method, which has no goal angles
COMBINATIONS = {"sum_over_bars": Combination.SUM, "nearest_bar": Combination.NEAREST}
_BLOCK = 50  # steps
_VIRTUAL_STEPS = 200
_VIRTUAL_TRIES = 3
#: Change of the potential over a block below which it counts as stalled.
_STALL = 1e-6


@dataclass(frozen=True)
class Method:
    """Settings the document leaves open; every field is the assumption of that name."""

    control_points: str
    window_distance: str
    update_rule: str
    step_gain: float
    max_step: float
    step_limit: float
    goal_tolerance: float
    stuck_rule: str
    stuck_threshold: float
    virtual_term: str
    virtual_switching: str
    virtual_release: float
    virtual_gain: float
    joint_term_weight: float
    joint_limits_in_motion: str

    @classmethod
    def of(cls, assumed: Mapping[str, Any]) -> Self:
        """The settings that the assumptions describe."""
        return cls(**{field.name: assumed[field.name] for field in fields(cls)})

    @property
    def enforced(self) -> bool:
        """Whether the joints are kept within the limits of the real robot."""
        return self.joint_limits_in_motion == "enforced"

    def update(self) -> Update:
        """Joint step."""
        gain = self.step_gain if self.update_rule == "gradient" else None
        return Update(rule=self.update_rule, max_step=self.max_step, gain=gain)

    def termination(self, *, joints: bool) -> Termination:
        """End of a plan, at the goal angles or at the goal position."""
        stalled = self.stuck_rule == "potential_stall"
        return Termination(
            joint_tolerance=self.goal_tolerance if joints else None,
            position_tolerance=None if joints else POSITION_TOLERANCE,
            step_limit=round(self.step_limit),
            trap=Trap(
                rule=self.stuck_rule,
                steps=_BLOCK,
                threshold=_STALL if stalled else self.stuck_threshold,
                after_obstacles_rest=True,
            ),
        )

    def repulsion(self) -> Repulsion:
        """(10) and (14) with the printed k_r and d_0."""
        combination = COMBINATIONS[self.window_distance]
        return Repulsion(gain=GAINS["k_r"], influence=GAINS["d_0"], combination=combination)

    def virtual_point(self, centre: np.ndarray, joints: np.ndarray) -> VirtualPoint:
        """Virtual point in the middle of the window; ``joints`` count if its term has angles."""
        with_joints = self.virtual_term == "position_and_joints"
        return VirtualPoint(
            gain=self.virtual_gain,
            position=tuple(centre.tolist()),
            joints=tuple(joints.tolist()) if with_joints else None,
            switching=self.virtual_switching,
            release_distance=self.virtual_release,
            max_steps=_VIRTUAL_STEPS,
            max_activations=_VIRTUAL_TRIES,
        )


def improved(
    method: Method, centre: np.ndarray, goal: np.ndarray, *, virtual: bool = True
) -> APFSettings:
    """(13)-(16) with the virtual point at ``centre``, or without it."""
    return APFSettings(
        attraction=Attraction(gain=GAINS["k_a"], joint_weight=method.joint_term_weight),
        control_points=method.control_points,
        repulsion=method.repulsion(),
        virtual_point=method.virtual_point(centre, goal) if virtual else None,
        update=method.update(),
        termination=method.termination(joints=True),
        enforce_limits=method.enforced,
    )


def joint_term_only(method: Method) -> APFSettings:
    """(13) without its position term, with (14)-(16) and no virtual point."""
    weight = method.joint_term_weight
    return APFSettings(
        attraction=Attraction(gain=GAINS["k_a"], position_weight=0.0, joint_weight=weight),
        control_points=method.control_points,
        repulsion=method.repulsion(),
        update=method.update(),
        termination=method.termination(joints=True),
        enforce_limits=method.enforced,
    )


def traditional(method: Method, reading: str, virtual_at: np.ndarray | None = None) -> APFSettings:
    """(9)-(12): the position attracts, the end effector or five points are repelled.

    Parameters
    ----------
    reading
        ``end_effector`` or ``five_points``.
    virtual_at
        Place of a virtual point that is added (no part of the method).
    """
    five = reading == "five_points"
    point = None if virtual_at is None else method.virtual_point(virtual_at, np.zeros(0))
    return APFSettings(
        attraction=Attraction(gain=GAINS["k_a"]),
        control_points=method.control_points if five else "end_effector",
        repulsion=method.repulsion(),
        virtual_point=point,
        update=method.update(),
        termination=method.termination(joints=False),
        enforce_limits=method.enforced,
    )


def attraction_only(method: Method) -> APFSettings:
    """(13) alone: nothing is avoided."""
    return APFSettings(
        attraction=Attraction(gain=GAINS["k_a"], joint_weight=method.joint_term_weight),
        control_points="end_effector",
        update=method.update(),
        termination=method.termination(joints=True),
        enforce_limits=method.enforced,
    )
