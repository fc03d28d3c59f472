"""Settings of the search from both ends: every gain is stated, every reading of a rule has a
name.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from ...settings import Positive, Settings
from ..settings import (
    Combination,
    Count,
    FlipRule,
    GainRule,
    PointSet,
    Share,
    StepRule,
    Threshold,
    UpdateOrder,
)

Factor = Annotated[float, Field(gt=0, le=1)]


class ConicAttraction(Settings):
    """Settings of the attraction of the joints, see :mod:`.joint_attraction`."""

    gain: Positive = Field(description="zeta")
    threshold: Positive = Field(description="d [rad]")
    measure: Threshold = Threshold.NORM


class PointRepulsionSettings(Settings):
    """Settings of the repulsion of control points, see :mod:`.repulsive_force`."""

    gain: Positive = Field(description="eta_0")
    influence: Positive = Field(description="rho_0 [m]")
    sources: Combination = Combination.NEAREST
    contact: Positive = Field(default=1e-3, description="shorter distances count as this one [m]")


class VariableGain(Settings):
    """Settings of the factor lambda of the repulsive gain, see :mod:`.variable_gain`."""

    rule: GainRule = GainRule.CONSTANT
    kappa: Factor = 0.8
    band: Positive = Field(default=0.05, description="delta_rho [m]")
    flip: FlipRule = FlipRule.NEGATIVE


class SearchStep(Settings):
    """Settings of the step length, see :mod:`.adaptive_step`."""

    length: Positive = Field(description="alpha_0 [rad]")
    rule: StepRule = StepRule.CONSTANT
    floor: Share = Field(default=0.2, description="smallest share of alpha_0")
    cap: Positive = Field(default=2.0, description="largest share of alpha_0")
    weights: tuple[Positive, ...] | None = Field(
        default=None, description="tau, one per control point; scaled to sum one, default equal"
    )

    @model_validator(mode="after")
    def _order(self) -> SearchStep:
        if self.floor > self.cap:
            raise ValueError("floor at most cap")
        return self


class Ending(Settings):
    """Settings of the end of a search."""

    tolerance: Positive = Field(description="|q - q_goal| or gap of the halves [rad]")
    search_limit: Count
    stuck_searches: Count = Field(description="searches without progress")
    stuck_progress: Positive = Field(default=1e-3, description="what counts as progress [rad]")


class BidirectionalSettings(Settings):
    """Everything that defines a search; two-sided, variable gain and step are switched one by
    one.
    """

    attraction: ConicAttraction
    repulsion: PointRepulsionSettings
    control_points: PointSet | tuple[Count, ...]
    radii: tuple[Share, ...] | None = Field(default=None, description="of the control points [m]")
    variable_gain: VariableGain = VariableGain()
    step: SearchStep
    two_sided: bool = True
    order: UpdateOrder = UpdateOrder.BEFORE
    ending: Ending
    enforce_limits: bool = Field(default=False, description="keep the joints within their limits")
