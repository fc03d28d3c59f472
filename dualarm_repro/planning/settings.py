"""Settings of the potential field planners: every gain is stated, every value checked.

The choices of the search from both ends are named here too, since its field and steps know them.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Literal

from pydantic import Field, model_validator

from ..settings import Positive, Settings

Share = Annotated[float, Field(ge=0)]
Count = Annotated[int, Field(ge=1)]
Point = tuple[float, float, float]


class Combination(StrEnum):
    """How the shapes that make up one obstacle, such as the bars of a window, repel together."""

    SUM = "sum"
    NEAREST = "nearest"


class UpdateRule(StrEnum):
    """How the potential moves the joints."""

    GRADIENT = "gradient"
    FIXED_LENGTH = "fixed_length"
    NEIGHBOUR_SEARCH = "neighbour_search"


class StuckRule(StrEnum):
    """What counts as standing still."""

    BLOCK_MEANS = "block_means"
    POTENTIAL_STALL = "potential_stall"


class Switching(StrEnum):
    """When a virtual attraction point acts."""

    ON_WHEN_STUCK = "on_when_stuck"
    REPLACES_GOAL = "replaces_goal"
    FROM_START = "from_start"
    ALWAYS = "always"


class Threshold(StrEnum):
    """What is compared with the threshold where the attraction turns from quadratic to conic."""

    NORM = "norm"
    PER_JOINT = "per_joint"


class GainRule(StrEnum):
    """Factor of the repulsive gain near the distance where the resultant has flipped."""

    CONSTANT = "constant"
    POWER = "power"
    RAMP = "ramp"
    PROPORTIONAL = "proportional"


class FlipRule(StrEnum):
    """Which cosine between successive resultants counts as a flip."""

    NEGATIVE = "negative"
    BELOW_MINUS_HALF = "below_minus_half"


class StepRule(StrEnum):
    """How the length of a step follows the distances of the control points."""

    CONSTANT = "constant"
    SATURATING = "saturating"
    PLAIN_DISTANCE = "plain_distance"
    RELATIVE = "relative"
    LENGTHENED = "lengthened"


class UpdateOrder(StrEnum):
    """Whether the backward half aims at the forward end from before or after its step."""

    BEFORE = "before"
    AFTER = "after"


#: Named sets of control points; frame n of an arm with n - 1 joints is its flange.
PointSet = Literal["end_effector", "frames_2_6", "frames_1_5", "five_links", "capsules"]


class Attraction(Settings):
    """Settings of k/2 (w_x |X - X_g|^2 + w_q |q - q_g|^2)."""

    gain: Positive = Field(description="k")
    position_weight: Share = Field(default=1.0, description="w_x")
    joint_weight: Share = Field(
        default=0.0, description="w_q [m^2/rad^2]; 0 leaves the joints free"
    )

    @model_validator(mode="after")
    def _some_term(self) -> Attraction:
        if self.position_weight == self.joint_weight == 0:
            raise ValueError("a weight that is not zero")
        return self


class Repulsion(Settings):
    """Settings of k/2 (1/d - 1/d_0)^2 for d < d_0, continued linearly below a contact distance."""

    gain: Positive = Field(description="k")
    influence: Positive = Field(description="d_0 [m]")
    combination: Combination = Combination.SUM
    contact: Positive = Field(default=1e-3, description="below it the potential is linear [m]")

    @model_validator(mode="after")
    def _order(self) -> Repulsion:
        if self.contact >= self.influence:
            raise ValueError("contact below influence")
        return self


class VirtualPoint(Settings):
    """Settings of a virtual attraction point k/2 (|X - X_v|^2 + w |q - q_v|^2) and its switch."""

    gain: Positive = Field(description="k")
    position: Point = Field(description="X_v in the world [m]")
    joints: tuple[float, ...] | None = Field(default=None, description="q_v [rad], if it has a say")
    joint_weight: Share = Field(default=1.0, description="w [m^2/rad^2], only with joints")
    switching: Switching
    release_distance: Positive = Field(description="|X - X_v| at which it is switched off [m]")
    max_steps: Count = Field(description="steps after which it is switched off anyway")
    max_activations: Count = Field(description="how often it is tried")


class Update(Settings):
    """Settings of the joint step."""

    rule: UpdateRule
    max_step: Positive = Field(
        description="[rad] gradient: bound of |dq|; fixed_length: |dq|; neighbour_search: |dq_j|"
    )
    gain: Positive | None = Field(default=None, description="gradient: from its value to the step")
    sufficient_decrease: Annotated[float, Field(gt=0, lt=1)] = Field(
        default=1e-4, description="gradient: share of the linear prediction a step must realise"
    )
    max_halvings: Count = Field(default=40, description="gradient: of a step that does not")

    @model_validator(mode="after")
    def _gain_of_gradient(self) -> Update:
        if (self.rule is UpdateRule.GRADIENT) != (self.gain is not None):
            raise ValueError("a gain for the rule gradient and for no other")
        return self


class Trap(Settings):
    """Settings of trap detection.

    ``block_means``: the mean configurations of two consecutive blocks of ``steps`` steps differ by
    less than ``threshold`` [rad] in every joint. ``potential_stall``: over ``steps`` steps the
    potential falls by less than ``threshold``.
    """

    rule: StuckRule
    steps: Count
    threshold: Positive
    after_obstacles_rest: bool = Field(
        default=False, description="no trap is called while an obstacle still moves"
    )


class Termination(Settings):
    """Settings of the end of a plan: all tolerances that are given must hold."""

    joint_tolerance: Positive | None = Field(default=None, description="max_j |q_j - q_gj| [rad]")
    position_tolerance: Positive | None = Field(default=None, description="|X - X_g| [m]")
    step_limit: Count
    trap: Trap
    near_goal: Positive = Field(
        default=10.0, description="multiple of the tolerances within which a trap is at the goal"
    )

    @model_validator(mode="after")
    def _some_tolerance(self) -> Termination:
        if self.joint_tolerance is None and self.position_tolerance is None:
            raise ValueError("joint_tolerance or position_tolerance")
        return self


class APFSettings(Settings):
    """Everything that defines an artificial potential field planner.

    Control points are a named set or frame numbers: 1 ... nq of the joints, nq + 1 of the flange.
    """

    attraction: Attraction
    control_points: PointSet | tuple[Count, ...]
    weights: tuple[Share, ...] | None = Field(default=None, description="one per control point")
    repulsion: Repulsion | None = Field(default=None, description="none: obstacles are ignored")
    virtual_point: VirtualPoint | None = None
    update: Update
    termination: Termination
    enforce_limits: bool = Field(default=False, description="keep the joints within their limits")
