"""Equations (10) and (12) of `qiu`: the variable gain and the adaptive step."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Residual, Result
from ...ledger.formula import parse
from ...planning.descent.adaptive_step import step_length
from ...planning.field.variable_gain import gain_factor
from ...planning.search.bidirectional_settings import GainRule, StepRule
from ...settings import code
from .printed_formula import value_of
from .readings import GAIN, TRADITIONAL, variable_gain_plan
from .scenario import ALPHA0, INFLUENCE
from .update_check import update_difference

checks = partial(REGISTRY.checks, page="qiu/field")
_LOST = "the formula"
_FLIPS = 3


@checks(
    "qiu.eq10",
    rules=[
        Residual(
            "step_difference",
            "steps of a search with variable gain against the printed product [rad]",
            high=1e-9,
        ),
        Residual("outside_band", "distance of lambda from one outside its band", high=1e-12),
        Bounded("at_flip", "lambda where the resultant has flipped", high="weaker"),
        NoOriginal("lambda", "the formula of lambda"),
    ],
)
def variable_gain(assumed: Assumed) -> Result:
    """The printed product in a run, and the factor in its three candidate forms."""
    rule, kappa, band = GainRule(assumed["gain_rule"]), assumed["kappa"], assumed["delta_rho"]
    at, offsets = 0.2, np.linspace(-0.15, 0.15, 61)

    def factors(chosen: GainRule) -> np.ndarray:
        return np.array(
            [gain_factor(code(chosen), kappa, band, at + x, at, _FLIPS) for x in offsets]
        )

    forms = {str(r): factors(r) for r in (GainRule.POWER, GainRule.RAMP, GainRule.PROPORTIONAL)}
    outside = np.abs(offsets) > band + 1e-9
    formula = parse(REGISTRY.printed("qiu.eq10")["formula"])
    names = (*TRADITIONAL, *GAIN)
    plan = variable_gain_plan({name: REGISTRY.assumption(f"qiu.{name}") for name in names})
    difference = update_difference(
        plan, 0, lambda factor, initial: value_of(formula, 1, {"lambda_": factor, "eta_0": initial})
    )
    return Result(
        obtained={
            "step_difference": difference,
            "outside_band": float(max(np.abs(f[outside] - 1.0).max() for f in forms.values())),
            "at_flip": float(forms[str(rule)][len(offsets) // 2]),
        },
        table=pd.DataFrame({"rho_minus_rho_s_m": offsets} | forms),
        caption=(
            f"With the printed product for the gain, every step of a run with "
            f"{plan.record.flips[0]} flips is what the code makes, to {difference:.0e} rad. After "
            f"{_FLIPS} flips the three candidate forms take lambda at the flip to "
            + ", ".join(f"{f[len(offsets) // 2]:.3f} ({name})" for name, f in forms.items())
            + " and leave it at one outside the band. Which of them was meant is not printed."
        ),
    )


@checks(
    "qiu.eq12",
    rules=[
        Is("rises", "the step never falls as the arm moves away from obstacles", value=True),
        Bounded("near_over_far", "step beside an obstacle over step far away", high="shorter"),
        Bounded(
            "flange_over_elbow", "gain of step by a far flange over a far elbow", low="heavier"
        ),
        NoOriginal("formula", _LOST),
    ],
)
def adaptive_step(assumed: Assumed) -> Result:
    """The step in its candidate forms, and which control point counts most."""
    tau = np.array(assumed["weights"], dtype=float)
    tau /= tau.sum()
    floor, chosen = assumed["step_floor"], StepRule(assumed["adaptive_step"])
    rho = np.linspace(0.0, 1.0, 101)

    def step(rule: StepRule, distances: np.ndarray) -> float:
        return step_length(code(rule), ALPHA0, floor, 2.0, tau, distances, INFLUENCE)

    forms = {str(rule): np.array([step(rule, np.full(3, r)) for r in rho]) for rule in StepRule}
    used = forms[str(chosen)]
    near = np.full(3, 0.5 * INFLUENCE)
    flange, elbow = (
        step(chosen, near + 0.5 * INFLUENCE * np.eye(3)[k]) - step(chosen, near) for k in (2, 0)
    )
    return Result(
        obtained={
            "rises": bool((np.diff(used) >= 0).all()),
            "near_over_far": float(used[0] / used[-1]),
            "flange_over_elbow": flange / elbow if elbow > 0.0 else None,
            "largest_over_alpha0": {name: float(f.max() / ALPHA0) for name, f in forms.items()},
        },
        table=pd.DataFrame({"rho_m": rho} | forms),
        caption=(
            f"The form used ({chosen}) takes the step from {used[0] / ALPHA0:.2f} of the first one "
            f"beside an obstacle to {used[-1] / ALPHA0:.2f} far away; of all forms "
            + ", ".join(name for name, f in forms.items() if f.max() > ALPHA0 * (1 + 1e-9))
            + " exceeds the first step, up to "
            f"{max(f.max() for f in forms.values()) / ALPHA0:g} times. The formula is lost."
        ),
    )
