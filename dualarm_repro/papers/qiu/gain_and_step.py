"""Equations (10) and (12) of `qiu`: the variable gain and the adaptive step."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...planning.adaptive_step import step_length
from ...planning.bidirectional_settings import FlipRule, GainRule, StepRule
from ...planning.settings import code
from ...planning.variable_gain import gain_factor, is_flip
from .scenario import ALPHA0, INFLUENCE

checks = partial(REGISTRY.checks, page="qiu/field")
_LOST = "the formula"


@checks(
    "qiu.eq10",
    rules=[
        Bounded(
            key="outside_band", high=1e-15, label="distance of lambda from one outside its band"
        ),
        Bounded(key="at_flip", high=0.999, label="lambda where the resultant flipped is below one"),
        NoOriginal(key="lambda", label="the formula of lambda"),
    ],
    samples=32,
)
def variable_gain(assumed: Assumed) -> Result:
    """The factor in its three candidate forms."""
    rule, kappa, band = GainRule(assumed["gain_rule"]), assumed["kappa"], assumed["delta_rho"]
    flips = 3 if is_flip(code(FlipRule(assumed["flip_rule"])), -1.0) else 0
    at, offsets = 0.2, np.linspace(-0.15, 0.15, 61)

    def factors(chosen: GainRule) -> np.ndarray:
        return np.array(
            [gain_factor(code(chosen), kappa, band, at + x, at, flips) for x in offsets]
        )

    forms = {str(r): factors(r) for r in (GainRule.POWER, GainRule.RAMP, GainRule.PROPORTIONAL)}
    outside = np.abs(offsets) > band + 1e-9
    return Result(
        obtained={
            "outside_band": float(max(np.abs(f[outside] - 1.0).max() for f in forms.values())),
            "at_flip": float(forms[str(rule)][len(offsets) // 2]),
        },
        table=pd.DataFrame({"rho_minus_rho_s_m": offsets} | forms),
        caption=(
            f"After {flips} flips the three candidate forms take the factor at the flip to "
            + ", ".join(f"{f[len(offsets) // 2]:.3f} ({name})" for name, f in forms.items())
            + " and leave it at one outside the band. Which of them was meant is not printed."
        ),
    )


@checks(
    "qiu.eq12",
    rules=[
        Is(
            key="rises",
            value=True,
            label="the step never falls as the arm moves away from obstacles",
        ),
        Bounded(
            key="near_over_far", high=0.999, label="step beside an obstacle over step far away"
        ),
        NoOriginal(key="formula", label=_LOST),
    ],
    samples=32,
)
def adaptive_step(assumed: Assumed) -> Result:
    """The step in its three candidate forms."""
    tau = np.array(assumed["weights"], dtype=float)
    tau /= tau.sum()
    floor, chosen = assumed["step_floor"], StepRule(assumed["adaptive_step"])
    rho = np.linspace(0.0, 1.0, 101)

    def steps(rule: StepRule) -> np.ndarray:
        return np.array(
            [
                step_length(code(rule), ALPHA0, floor, 2.0, tau, np.full(3, r), INFLUENCE)
                for r in rho
            ]
        )

    rules = (StepRule.SATURATING, StepRule.PLAIN_DISTANCE, StepRule.RELATIVE)
    forms = {str(rule): steps(rule) for rule in rules}
    used = forms[str(chosen)]
    return Result(
        obtained={
            "rises": bool((np.diff(used) >= 0).all()),
            "near_over_far": float(used[0] / used[-1]),
            "largest_over_alpha0": {name: float(f.max() / ALPHA0) for name, f in forms.items()},
        },
        table=pd.DataFrame({"rho_m": rho} | forms),
        caption=(
            "All candidates shorten the step near obstacles; only the relative form ever exceeds "
            "the "
            f"first step, up to {forms['relative'].max() / ALPHA0:g} times. The formula is lost."
        ),
    )
