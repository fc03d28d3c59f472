"""Settings of the velocity controller, checked when they are made."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, NamedTuple

from pydantic import Field, ValidationInfo, field_validator

from ..settings import Positive, Settings, numbers

NotNegative = Annotated[float, Field(ge=0)]


class Damper(StrEnum):
    """How the bound on the approach of a pair depends on its distance, as in :mod:`.damper`."""

    LINEAR = "linear"
    SINE_SQUARED = "sine_squared"
    STEP = "step"
    ZERO_INSIDE = "zero_inside"


class RowForm(StrEnum):
    """What is bounded: readings of the row J_N of a pair, as in :mod:`.avoidance`."""

    PAIR_NORMAL = "pair_normal"
    ARM_NORMAL = "arm_normal"
    PAIR_AXES = "pair_axes"
    ARM_AXES = "arm_axes"
    PAIR_COMPONENTS = "pair_components"


class PairSelection(StrEnum):
    """Which of the pairs within the outer range give rows."""

    ALL_WITHIN_OUTER = "all_within_outer"
    NEAREST_PER_LINK = "nearest_per_link"
    SINGLE_NEAREST = "single_nearest"


#: Rows that one pair gives at most.
ROWS_PER_PAIR = {
    RowForm.PAIR_NORMAL: 1,
    RowForm.ARM_NORMAL: 2,
    RowForm.PAIR_AXES: 3,
    RowForm.ARM_AXES: 6,
    RowForm.PAIR_COMPONENTS: 3,
}


class ControllerNumbers(NamedTuple):
    """The settings as the kernels read them; a choice is its number, see ``settings.code``."""

    feedback: float
    repetition: float
    avoid: bool
    form: int
    rows_per_pair: int
    selection: int
    damper: int
    damper_gain: float
    outer: float
    inner: float
    thickness: float
    limits: bool
    angle_limits: bool
    limit_gain: float
    limit_margin: float


class ControllerSettings(Settings):
    """Settings of the velocity problem.

    Raises
    ------
    InputError
        A gain, range or margin that is negative or not finite; outer not beyond inner.
    UnknownNameError
        A choice that does not exist.
    """

    feedback: NotNegative = Field(default=10.0, description="K in J x = dr/dt + K (r - f(q)) [1/s]")
    repetition: NotNegative = Field(
        default=0.0,
        description="lambda of the pull to the start, 1/2 |x + lambda (q - q_0)|^2 [1/s]",
    )
    avoid: bool = Field(default=True, description="pairs within the outer range give rows")
    form: RowForm = RowForm.PAIR_NORMAL
    selection: PairSelection = PairSelection.ALL_WITHIN_OUTER
    damper: Damper = Damper.LINEAR
    damper_gain: Positive = Field(
        default=5.0, description="slope k of the linear damper beta = k (d - inner) [1/s]"
    )
    inner: NotNegative = Field(default=0.03, description="d2, which is kept [m]")
    outer: Positive = Field(
        default=0.10, validate_default=True, description="d1, where a pair becomes active [m]"
    )
    surface: bool = Field(
        default=True, description="distances between link surfaces, else between capsule axes"
    )
    limits: bool = Field(default=True, description="joint speeds are bounded")
    angle_limits: bool = Field(default=True, description="the bounds shrink towards angle limits")
    limit_gain: Positive = Field(
        default=5.0, description="k in x_i <= k (upper_i - limit_margin - q_i) [1/s]"
    )
    limit_margin: NotNegative = Field(default=0.05, description="[rad]")

    @field_validator("outer")
    @classmethod
    def _beyond_inner(cls, outer: float, info: ValidationInfo) -> float:
        inner = info.data.get("inner")
        if inner is not None and not outer > inner:
            raise ValueError(f"more than inner, {inner:g} m")
        return outer

    def numbers(self) -> ControllerNumbers:
        """For the kernels."""
        rows, thickness = ROWS_PER_PAIR[self.form], float(self.surface)
        return numbers(ControllerNumbers, self, rows_per_pair=rows, thickness=thickness)
