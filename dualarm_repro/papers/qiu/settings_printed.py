"""Gains, lengths and intervals that `qiu` prints for its field, as the runs are fed with them."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...ledger import REGISTRY, Adopts, Assumed, Bounded, Result, Role
from ...ledger.printed import EXACT
from .readings import master_posture
from .scenario import ALPHA0, CENTRES, INFLUENCE, MASTER_GOAL, RADIUS, START, THRESHOLD, ZETA

inputs = partial(REGISTRY.checks, page="qiu/field")
_SCALE = {"rad": 1.0, "deg": np.pi / 180.0}


@inputs(
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
    unit = assumed["angle_unit"]
    straight = float(np.linalg.norm(master_posture(assumed) - START))
    needed = straight / (ALPHA0 * _SCALE[unit])
    searches = REGISTRY.printed("qiu.claim_bi_counts")
    made = sum(int(searches[half]) for half in ("forward", "backward"))
    return Result(
        obtained={
            "alpha0": ALPHA0,
            "steps_missing": needed - made,
            "steps_for_the_straight_line": needed,
            "least_mean_step_over_alpha0": needed / made,
        },
        caption=(
            f"The step is used as printed, in {unit}: the straight line of {straight:.2f} rad from "
            f"start to goal takes {needed:.0f} of them, the printed searches of both ends make "
            f"{made}. A mean step below {needed / made:.2f} of it could not have met print."
        ),
    )


@inputs("qiu.claim_d", samples=32, rules=[Adopts("d", "threshold of the attraction", to="d")])
def threshold(assumed: Assumed) -> Result:
    """The threshold d, and the bound on the attraction it gives."""
    bound = THRESHOLD * ZETA
    return Result(
        obtained={"d": THRESHOLD, "largest_attraction": bound},
        caption=f"The threshold is used as printed; the attraction never exceeds {bound:g}.",
    )


@inputs("qiu.claim_zeta", samples=32, rules=[Adopts("zeta", "attractive gain", to="zeta")])
def attractive_gain(assumed: Assumed) -> Result:
    """The attractive gain."""
    return Result(
        obtained={"zeta": ZETA},
        caption=(
            "The gain is used as printed. As every step has the same length, only the ratio of the "
            "repulsive gain to it counts."
        ),
    )


@inputs(
    "qiu.claim_eta0",
    rules=[Adopts("eta0", "initial repulsive gain", to="eta0")],
    change="another ratio to the attractive gain",
    samples=32,
)
def repulsive_gain(assumed: Assumed) -> Result:
    """The initial repulsive gain."""
    eta0 = assumed["gain_ratio"] * ZETA
    return Result(
        obtained={"eta0": eta0},
        caption=f"The initial repulsive gain of the runs at face value is {eta0:g}.",
    )


@inputs("qiu.claim_rho0", rules=[Adopts("rho0", "range of the repulsion [m]", to="rho0")])
def repulsion_range(assumed: Assumed) -> Result:
    """The range of the repulsion."""
    centres = np.linalg.norm(MASTER_GOAL - CENTRES, axis=1) - RADIUS
    return Result(
        obtained={"rho0": INFLUENCE, "spheres_within": int((centres < INFLUENCE).sum())},
        caption=(
            "The range is used as printed, as the greatest distance; "
            f"{(centres < INFLUENCE).sum()} of "
            "the spheres are within it of the printed goal."
        ),
    )


@inputs(
    "qiu.claim_kappa_range",
    rules=[
        Bounded("beyond", "kappa beyond the printed interval", high=0.0, role=Role.ADOPTS),
    ],
)
def kappa_range(assumed: Assumed) -> Result:
    """The constant of the variable gain lies in the printed interval."""
    kappa, text = assumed["kappa"], REGISTRY.printed("qiu.claim_kappa_range")["kappa"]
    low, high = (float(end) for end in text[1:-1].split(","))
    outside = (kappa == low and text[0] == "(") or (kappa == high and text[-1] == ")")
    beyond = max(low - kappa, kappa - high, EXACT if outside else -np.inf)
    return Result(
        obtained={"beyond": float(beyond), "kappa": kappa},
        caption=(
            f"kappa = {kappa:g} is {'inside' if beyond <= 0.0 else 'outside'} the printed interval "
            f"{text}. With a gain that falls as a power, kappa = 1 leaves it constant."
        ),
    )


@inputs(
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
    return Result(
        obtained={"least_difference": least, "weights": list(tau)},
        caption=(
            f"Weights {', '.join(map(str, tau))}: "
            f"{'in' if least > 0.0 else 'not in'} the printed order {text}."
        ),
    )
