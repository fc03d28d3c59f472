"""Equations (11) and (13)-(16) of `qiu`, and the claims on smoothing and the adaptive step."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, Generally, Is, NoOriginal, Residual, Result
from .....ledger.assumptions import alternatives
from .....ledger.captions import captions
from .....ledger.witnesses import cell_witnesses
from .....planning.checks.recorded_steps import step_difference
from .....planning.search.splice import roughness, smoothed, smoothed_directly
from ...document import PRINTED, SEED
from ...reading import Improved, Traditional
from ...studies.improvements import IMPROVEMENTS, STEP_RULES, nearest

checks = partial(REGISTRY.checks, page="qiu/two_sided")
caption = captions(__file__)
_MU = (0.0, 0.1, 1.0, 10.0, 100.0)
_END_WEIGHTS = (1.0, 1e3, 1e6)


@checks(
    "qiu.eq11",
    rules=[
        Residual("step_error", "length of a step minus alpha [rad]", high=1e-12),
        Bounded("end", "joint error at the end beyond the tolerance [rad]", high=0.0),
        NoOriginal("formula", "the formula"),
    ],
)
def next_configuration(assumed: Assumed) -> Result:
    """Steps of length alpha along the resultant until the error is below the tolerance."""
    tolerance = assumed["joint_tolerance"]
    plan = Traditional.nominal(
        gain_ratio=1e-4, step_rule=assumed["step_rule"], joint_tolerance=tolerance
    ).plan()
    steps = np.linalg.norm(np.diff(plan.path, axis=0), axis=1)
    error = float(np.abs(steps - plan.problem.settings.step.length).max())
    end = plan.gap - tolerance
    return Result(
        obtained={"step_error": error, "end": end, "searches": plan.searches},
        caption=caption("eq11", gap=plan.gap),
    )


def _register_update(item: str, side: int, half: str, other: str) -> None:
    """The check of the steps of one half."""

    @checks(
        f"qiu.{item}",
        rules=[
            Residual(
                "difference", f"steps of the {half} half against the formula [rad]", high=1e-9
            ),
            NoOriginal("formula", "the formula"),
        ],
    )
    def update(assumed: Assumed) -> Result:
        """Every step of the half in both orders, recomputed with the other end as its goal."""
        plans = [Improved.nominal(update_order=order).plan() for order in ("before", "after")]
        difference = max(step_difference(plan, side) for plan in plans)
        told = caption("update", half=half, other=other)
        return Result(obtained={"difference": difference}, caption=told)


_register_update("eq13", 0, "forward", "backward")
_register_update("eq14", 1, "backward", "forward")


@checks(
    "qiu.eq15",
    rules=[
        Bounded("beyond", "gap of the halves beyond the tolerance [rad]", high=0.0),
        Bounded("earlier", "smallest earlier gap above the tolerance by [rad]", low=0.0),
        Bounded(
            "room",
            "largest gap of the tips that the tolerance allows, minus the printed gap [m]",
            low=0.0,
        ),
        NoOriginal("tolerance", "the tolerance"),
    ],
)
def meeting_test(assumed: Assumed) -> Result:
    """The gap of the halves falls below the tolerance at the last search and not before; a gap of
    the tips as printed is possible with it."""
    tolerance = assumed["joint_tolerance"]
    plan = Improved.nominal(joint_tolerance=tolerance).plan()
    forward, backward = plan.record.paths
    gaps = np.linalg.norm(forward - backward, axis=1)
    arm = plan.problem.placed.arm
    q = arm.random_configurations(2000, np.random.default_rng(SEED))
    lever = float(np.linalg.norm(arm.jacobian(q)[:, :3], ord=2, axis=(1, 2)).max())
    printed = [
        float(np.linalg.norm(np.subtract(*ends)))
        for ends in (PRINTED.meeting, PRINTED.slave_meeting)
    ]
    return Result(
        obtained={
            "beyond": float(gaps[-1] - tolerance),
            "earlier": float(gaps[:-1].min() - tolerance),
            "room": lever * tolerance - max(printed),
            "gap_tip": float(np.linalg.norm(plan.ends[0] - plan.ends[1])),
            "printed_gaps": printed,
        },
        caption=caption("eq15", gaps=gaps[[0, -1]], tolerance=tolerance, allowed=lever * tolerance),
    )


@checks(
    "qiu.eq16",
    rules=[
        Residual("difference", "spline against its normal equations [rad]", high=1e-8),
        NoOriginal("formula", "the formula"),
    ],
)
def smoothing_criterion(assumed: Assumed) -> Result:
    """The library's spline against a direct minimisation of the criterion."""
    path = Improved.nominal().plan().path
    pairs = [
        (smoothed(path, mu, weight), smoothed_directly(path, mu, weight))
        for mu in _MU[1:]
        for weight in _END_WEIGHTS
    ]
    difference = max(float(np.abs(one - other).max()) for one, other in pairs)
    return Result(
        obtained={"difference": difference, "cases": len(pairs)},
        caption=caption("eq16", mu=_MU, weights=_END_WEIGHTS),
    )


@checks(
    "qiu.claim_mu_nonneg",
    rules=[
        Is("falling", "roughness falls as mu grows", value=True),
        Is("within_print", "all values declared for mu are as printed", value=True),
    ],
)
def smoothing_sense(assumed: Assumed) -> Result:
    """Roughness of the fitted spline over mu, and the declared range of mu against print."""
    path = Improved.nominal().plan().path
    values = [roughness(smoothed_directly(path, mu, 1.0)) for mu in _MU]
    sign, bound = REGISTRY.printed("qiu.claim_mu_nonneg")["mu"].split()
    declared = alternatives("qiu.smoothing_weight", 2)
    compare = {">=": np.greater_equal, ">": np.greater, "<=": np.less_equal, "<": np.less}[sign]
    return Result(
        obtained={
            "falling": bool((np.diff(values) < 0).all()),
            "within_print": bool(compare(declared, float(bound)).all()),
            "roughness": values,
        },
        table=pd.DataFrame({"mu": _MU, "roughness_rad2": values}),
        caption=caption("claim_mu_nonneg", mu=_MU, declared=declared, sign=sign, bound=bound),
    )


@checks(
    "qiu.claim_steps_efficiency",
    rules=[
        Generally(
            "faster",
            "random tasks in which the adaptive step needs fewer searches than the constant one",
            at_least="most",
            margin="margin",
        )
    ],
)
def adaptive_efficiency(assumed: Assumed) -> Result:
    """Searches with adaptive and with constant step on the random tasks that both solve."""
    rule, ratio = assumed["adaptive_step"], nearest(assumed["gain_ratio"])
    table = IMPROVEMENTS.load()
    table = table[table["gain_ratio"] == ratio]
    both = table[table[f"reached_{rule}"] & table["reached_constant"]]
    faster = both[f"searches_{rule}"] < both["searches_constant"]
    obtained = {
        "faster": {"count": int(faster.sum()), "of": len(both)},
        "median_searches": {
            name: float(both[f"searches_{name}"].median()) for name in ("constant", rule)
        },
        "median_ratio": float((both[f"searches_{rule}"] / both["searches_constant"]).median()),
        "solved": {name: int(table[f"reached_{name}"].sum()) for name in STEP_RULES},
        "tasks": len(table),
        "ratio": ratio,
    }
    return Result(
        obtained=obtained,
        caption=caption("claim_steps_efficiency", rule=rule),
        witnesses=cell_witnesses(
            "qiu.claim_steps_efficiency",
            obtained,
            both,
            faster,
            ("task", "searches_constant", f"searches_{rule}"),
        ),
    )
