"""Equations (10) and (12) of `qiu`, and the gains, lengths and intervals printed for its field."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Adopts, Assumed, Bounded, Is, NoOriginal, Residual, Result, Role
from .....ledger.captions import captions
from .....ledger.printed import EXACT
from .....ledger.printed_values import printed_numbers
from .....planning.checks.recorded_steps import step_difference
from .....planning.descent.adaptive_step import step_length
from .....planning.field.variable_gain import gain_factor
from .....planning.search.bidirectional_settings import GainRule, StepRule
from .....settings import code
from ...document import PRINTED, goal_to_surface, printed_side
from ...reading import ANGLE_UNITS, Goal, VariableGain

checks = partial(REGISTRY.checks, page="qiu/field")
caption = captions(__file__)
_FLIPS = 3


@checks(
    "qiu.eq10",
    rules=[
        Residual(
            "step_difference",
            "steps of a search with variable gain against the printed product [rad]",
            high=1e-9,
        )
    ],
)
def variable_gain(assumed: Assumed) -> Result:
    """The printed product, in every step of a run."""
    plan = VariableGain.nominal().plan()
    difference = step_difference(
        plan, 0, lambda factor, eta: printed_side("eq10", 1, {"lambda_": factor, "eta_0": eta})
    )
    return Result(obtained={"step_difference": difference}, caption=caption("eq10", plan=plan))


@checks(
    "qiu.eq10_lambda",
    rules=[
        Residual("outside_band", "distance of lambda from one outside its band", high=1e-12),
        Bounded("at_flip", "lambda where the resultant has flipped", high="weaker"),
        NoOriginal("lambda", "the formula of lambda"),
    ],
)
def gain_factors(assumed: Assumed) -> Result:
    """The factor in its three candidate forms."""
    rule, kappa, band = GainRule(assumed["gain_rule"]), assumed["kappa"], assumed["delta_rho"]
    at, offsets = 0.2, np.linspace(-0.15, 0.15, 61)
    outside, middle = np.abs(offsets) > band + 1e-9, len(offsets) // 2
    forms = {
        str(r): np.array([gain_factor(code(r), kappa, band, at + x, at, _FLIPS) for x in offsets])
        for r in (GainRule.POWER, GainRule.RAMP, GainRule.PROPORTIONAL)
    }
    return Result(
        obtained={
            "outside_band": float(max(np.abs(f[outside] - 1.0).max() for f in forms.values())),
            "at_flip": float(forms[str(rule)][middle]),
        },
        table=pd.DataFrame({"rho_minus_rho_s_m": offsets} | forms),
        caption=caption("eq10_lambda", most=_FLIPS, forms=forms, middle=middle),
    )


@checks(
    "qiu.eq12",
    rules=[
        Is("rises", "the step never falls as the arm moves away from obstacles", value=True),
        Bounded("near_over_far", "step beside an obstacle over step far away", high="shorter"),
        Bounded(
            "flange_over_elbow", "gain of step by a far flange over a far elbow", low="heavier"
        ),
        NoOriginal("formula", "the formula"),
    ],
)
def adaptive_step(assumed: Assumed) -> Result:
    """The step in its candidate forms, and which control point counts most."""
    tau = np.array(assumed["weights"], dtype=float)
    tau /= tau.sum()
    floor, chosen = assumed["step_floor"], StepRule(assumed["adaptive_step"])
    alpha0, influence = PRINTED.alpha0, PRINTED.influence
    rho = np.linspace(0.0, 1.0, 101)

    def step(rule: StepRule, distances: np.ndarray) -> float:
        return step_length(code(rule), alpha0, floor, 2.0, tau, distances, influence)

    forms = {str(rule): np.array([step(rule, np.full(3, r)) for r in rho]) for rule in StepRule}
    used = forms[str(chosen)]
    near = np.full(3, 0.5 * influence)
    flange, elbow = (
        step(chosen, near + 0.5 * influence * np.eye(3)[k]) - step(chosen, near) for k in (2, 0)
    )
    return Result(
        obtained={
            "rises": bool((np.diff(used) >= 0).all()),
            "near_over_far": float(used[0] / used[-1]),
            "flange_over_elbow": flange / elbow if elbow > 0.0 else None,
            "largest_over_alpha0": {name: float(f.max() / alpha0) for name, f in forms.items()},
        },
        table=pd.DataFrame({"rho_m": rho} | forms),
        caption=caption("eq12", chosen=chosen, ends=used[[0, -1]] / alpha0),
    )


@checks(
    "qiu.claim_alpha0",
    rules=[
        Adopts("alpha0", "first step", to="alpha0"),
        Bounded(
            "steps_missing",
            "steps of the straight joint line beyond those that the printed searches of both ends "
            "make",
            high=0.0,
        ),
    ],
)
def first_step(assumed: Assumed) -> Result:
    """The first step, and whether the printed searches cover the straight line in its unit."""
    unit, alpha0 = assumed["angle_unit"], PRINTED.alpha0
    straight = float(np.linalg.norm(Goal.of(assumed).posture() - PRINTED.start))
    needed = straight / (alpha0 * ANGLE_UNITS[unit])
    made = int(printed_numbers("qiu.claim_bi_counts", "forward", "backward").sum())
    return Result(
        obtained={
            "alpha0": alpha0,
            "steps_missing": needed - made,
            "steps_for_the_straight_line": needed,
            "least_mean_step_over_alpha0": needed / made,
        },
        caption=caption("claim_alpha0", unit=unit, straight=straight, made=made),
    )


@checks("qiu.claim_d", samples=32, rules=[Adopts("d", "threshold of the attraction", to="d")])
def threshold(assumed: Assumed) -> Result:
    """The threshold d, and the bound on the attraction it gives."""
    bound = PRINTED.threshold * PRINTED.zeta
    return Result(
        obtained={"d": PRINTED.threshold, "largest_attraction": bound},
        caption=f"The threshold is used as printed; the attraction never exceeds {bound:g}.",
    )


@checks("qiu.claim_zeta", samples=32, rules=[Adopts("zeta", "attractive gain", to="zeta")])
def attractive_gain(assumed: Assumed) -> Result:
    """The attractive gain."""
    return Result({"zeta": PRINTED.zeta}, caption("claim_zeta"))


@checks(
    "qiu.claim_eta0",
    rules=[Adopts("eta0", "initial repulsive gain", to="eta0")],
    change="another ratio to the attractive gain",
    samples=32,
)
def repulsive_gain(assumed: Assumed) -> Result:
    """The initial repulsive gain."""
    eta0 = assumed["gain_ratio"] * PRINTED.zeta
    return Result(
        obtained={"eta0": eta0},
        caption=f"The initial repulsive gain of the runs at face value is {eta0:g}.",
    )


@checks("qiu.claim_rho0", rules=[Adopts("rho0", "range of the repulsion [m]", to="rho0")])
def repulsion_range(assumed: Assumed) -> Result:
    """The range of the repulsion."""
    rho0 = PRINTED.influence
    within = int((goal_to_surface() < rho0).sum())
    return Result({"rho0": rho0, "spheres_within": within}, caption("claim_rho0"))


@checks(
    "qiu.claim_kappa_range",
    rules=[Bounded("beyond", "kappa beyond the printed interval", high=0.0, role=Role.ADOPTS)],
)
def kappa_range(assumed: Assumed) -> Result:
    """The constant of the variable gain lies in the printed interval."""
    kappa, text = assumed["kappa"], REGISTRY.printed("qiu.claim_kappa_range")["kappa"]
    low, high = (float(end) for end in text[1:-1].split(","))
    outside = (kappa == low and text[0] == "(") or (kappa == high and text[-1] == ")")
    beyond = max(low - kappa, kappa - high, EXACT if outside else -np.inf)
    told = caption("claim_kappa_range", interval=text)
    return Result({"beyond": float(beyond), "kappa": kappa}, told)


@checks(
    "qiu.claim_tau_order",
    rules=[
        Bounded(
            "least_difference",
            "smallest difference of neighbours in the printed order, of weights with sum one",
            low=EXACT,
            role=Role.ADOPTS,
        )
    ],
)
def weight_order(assumed: Assumed) -> Result:
    """The weights of the control points are in the printed order."""
    tau, text = assumed["weights"], REGISTRY.printed("qiu.claim_tau_order")["order"]
    known = {f"tau_{k}": weight / sum(tau) for k, weight in enumerate(tau, 1)}
    chain = [known[name] if name in known else float(name) for name in text.split(" > ")]
    least = float(-np.diff(chain).max())
    told = caption("claim_tau_order", order=text)
    return Result({"least_difference": least, "weights": list(tau)}, told)
