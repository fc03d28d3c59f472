"""The planners of `xue`: improved, traditional, and attraction alone, from the assumptions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Self

import numpy as np

from ...ledger.assumptions import FromAssumptions
from ...planning.settings import (
    APFSettings,
    Attraction,
    Combination,
    PointSet,
    Repulsion,
    Termination,
    Trap,
    Update,
    VirtualPoint,
)
from .document import Layout, assumptions, gains

POSITION_TOLERANCE = 0.02  # [m] of the traditional method, which has no goal angles
COMBINATIONS = {"sum_over_bars": Combination.SUM, "nearest_bar": Combination.NEAREST}
#: Steps of a block, over which the criterion of a trap takes its means.
BLOCK = 50
_VIRTUAL_STEPS = 200
_VIRTUAL_TRIES = 3
#: Change of the potential over a block below which it counts as stalled.
_STALL = 1e-6


@dataclass(frozen=True)
class PlannerChoice(FromAssumptions):
    """Settings of a planner that the document leaves open; each is the assumption of that name."""

    control_points: PointSet
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

    def settings(self, attraction: Attraction, *, joints: bool = True, **parts: Any) -> APFSettings:
        """A planner that ends at the goal angles, or at the goal position, with further parts."""
        gain = self.step_gain if self.update_rule == "gradient" else None
        least = _STALL if self.stuck_rule == "potential_stall" else self.stuck_threshold
        trap = Trap(rule=self.stuck_rule, steps=BLOCK, threshold=least, after_obstacles_rest=True)
        return APFSettings(
            attraction=attraction,
            update=Update(rule=self.update_rule, max_step=self.max_step, gain=gain),
            termination=Termination(
                joint_tolerance=self.goal_tolerance if joints else None,
                position_tolerance=None if joints else POSITION_TOLERANCE,
                step_limit=round(self.step_limit),
                trap=trap,
            ),
            enforce_limits=self.joint_limits_in_motion == "enforced",
            **parts,
        )

    def attraction(self, **weights: float) -> Attraction:
        """(9), or (13) with the weight of the joint term."""
        return Attraction(gain=gains()["k_a"], **weights)

    def repulsion(self) -> Repulsion:
        """(10) and (14) with the printed k_r and d_0."""
        printed, combination = gains(), COMBINATIONS[self.window_distance]
        return Repulsion(gain=printed["k_r"], influence=printed["d_0"], combination=combination)

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
    planner: PlannerChoice,
    centre: np.ndarray,
    goal: np.ndarray,
    *,
    virtual: bool = True,
    position_weight: float = 1.0,
) -> APFSettings:
    """(13)-(16) with the virtual point at ``centre``; it and the position term can be left out."""
    return planner.settings(
        planner.attraction(position_weight=position_weight, joint_weight=planner.joint_term_weight),
        control_points=planner.control_points,
        repulsion=planner.repulsion(),
        virtual_point=planner.virtual_point(centre, goal) if virtual else None,
    )


def traditional(
    planner: PlannerChoice, reading: str, virtual_at: np.ndarray | None = None
) -> APFSettings:
    """(9)-(12): the position attracts, the end effector or five points are repelled.

    Parameters
    ----------
    reading
        ``end_effector`` or ``five_points``.
    virtual_at
        Place of a virtual point that is added (no part of the method).
    """
    point = None if virtual_at is None else planner.virtual_point(virtual_at, np.zeros(0))
    return planner.settings(
        planner.attraction(),
        joints=False,
        control_points=planner.control_points if reading == "five_points" else "end_effector",
        repulsion=planner.repulsion(),
        virtual_point=point,
    )


def attraction_only(planner: PlannerChoice) -> APFSettings:
    """(13) alone: nothing is avoided."""
    attraction = planner.attraction(joint_weight=planner.joint_term_weight)
    return planner.settings(attraction, control_points="end_effector")


@dataclass(frozen=True)
class Encounter(FromAssumptions):
    """How the arms meet; every field is the assumption of that name."""

    master_as_obstacle: str
    equal_speed_meaning: str


class Case(NamedTuple):
    """Everything two motions depend on."""

    layout: Layout
    planner: PlannerChoice
    encounter: Encounter

    @classmethod
    def of(cls, assumed: Mapping[str, Any]) -> Self:
        """The case that the assumptions describe."""
        return cls(Layout.of(assumed), PlannerChoice.of(assumed), Encounter.of(assumed))


#: The assumptions that a case reads.
CASE = (*Layout.names(), *PlannerChoice.names(), *Encounter.names())
_PLACES = ("master_base_", "base_distance", "window_centre", "window_normal", "window_opening",
           "window_bar")  # fmt: skip
#: What a random arrangement keeps of them: all but the place of bases and window.
KEPT = tuple(name for name in CASE if not name.startswith(_PLACES))


def nominal(**changed: Any) -> Case:
    """The case of the assumptions as they stand, but for those that are given."""
    return Case.of({**assumptions(*CASE), **changed})
