"""Settings of the velocity controller, checked when they are made."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple

from ..errors import InputError, UnknownNameError

#: How the bound on the approach of a pair depends on its distance.
DAMPERS = ("linear", "sine_squared", "step", "zero_inside")
#: What is bounded: readings of the row J_N of a pair.
FORMS = ("pair_normal", "arm_normal", "pair_axes", "arm_axes", "pair_components")
#: Which of the pairs within the outer range give rows.
SELECTIONS = ("all_within_outer", "nearest_per_link", "single_nearest")
#: Rows that one pair gives under each form.
ROWS = (1, 2, 3, 6, 3)


class Numbers(NamedTuple):
    """The settings as the kernels read them; names are numbered in the order of the lists above."""

    feedback: float
    repetition: float
    avoid: bool
    form: int
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


@dataclass(frozen=True, kw_only=True)
class Settings:
    """Settings of the velocity problem.

    Attributes
    ----------
    feedback : float
        K in J x = dr/dt + K (r - f(q)) [1/s].
    repetition : float
        Weight lambda of the pull to the start, objective 1/2 |x + lambda (q - q_0)|^2 [1/s].
    avoid : bool
        Whether pairs within ``outer`` give rows.
    form, selection, damper : str
        Of :data:`FORMS`, :data:`SELECTIONS`, :data:`DAMPERS`.
    damper_gain : float
        Slope k of the linear damper beta = k (d - inner) [1/s].
    outer, inner : float
        d1, where a pair becomes active, and d2, which is kept [m].
    surface : bool
        Distances between link surfaces, else between capsule axes.
    limits, angle_limits : bool
        Whether the joint speeds are bounded, and whether the bounds shrink towards angle limits.
    limit_gain, limit_margin : float
        x_i <= limit_gain (upper_i - limit_margin - q_i) [1/s], [rad].

    Raises
    ------
    InputError
        A gain, range or margin that is negative or not finite; outer not beyond inner.
    UnknownNameError
        A name that is not in its list.
    """

    feedback: float = 10.0
    repetition: float = 0.0
    avoid: bool = True
    form: str = "pair_normal"
    selection: str = "all_within_outer"
    damper: str = "linear"
    damper_gain: float = 5.0
    outer: float = 0.10
    inner: float = 0.03
    surface: bool = True
    limits: bool = True
    angle_limits: bool = True
    limit_gain: float = 5.0
    limit_margin: float = 0.05

    def __post_init__(self) -> None:
        for name in ("feedback", "repetition", "inner", "limit_margin"):
            _require(name, getattr(self, name), 0.0, strict=False)
        for name in ("damper_gain", "limit_gain", "outer"):
            _require(name, getattr(self, name), 0.0, strict=True)
        if not self.outer > self.inner:
            raise InputError("Settings", "outer", self.outer, f"more than inner, {self.inner:g} m")
        for name, known in (("form", FORMS), ("selection", SELECTIONS), ("damper", DAMPERS)):
            if getattr(self, name) not in known:
                raise UnknownNameError(
                    "Settings", name, getattr(self, name), f"one of {', '.join(known)}"
                )

    @property
    def closing_speed(self) -> float:
        """Approach that the damper allows where a pair enters, k (d1 - d2) [m/s].

        Faster approach is braked at once, so that the joint velocity jumps there.
        """
        return self.damper_gain * (self.outer - self.inner)

    def numbers(self) -> Numbers:
        """For the kernels."""
        return Numbers(
            float(self.feedback),
            float(self.repetition),
            bool(self.avoid),
            FORMS.index(self.form),
            SELECTIONS.index(self.selection),
            DAMPERS.index(self.damper),
            float(self.damper_gain),
            float(self.outer),
            float(self.inner),
            1.0 if self.surface else 0.0,
            bool(self.limits),
            bool(self.angle_limits),
            float(self.limit_gain),
            float(self.limit_margin),
        )


def _require(name: str, value: float, least: float, *, strict: bool) -> None:
    ok = (
        isinstance(value, int | float)
        and isfinite(value)
        and (value > least or (not strict and value == least))
    )
    if not ok:
        raise InputError(
            "Settings", name, value, f"a number {'above' if strict else 'of at least'} {least:g}"
        )
