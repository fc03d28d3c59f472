"""Equations (11) and (13)-(16) of `qiu`, and the claims on smoothing and the adaptive step."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...planning.bidirectional import repulsive_torque, surroundings_at
from ...planning.joint_attraction import conic_force
from ...planning.search_plan import SearchPlan
from ...planning.splice import roughness, smoothed, smoothed_directly
from .readings import (
    IMPROVED,
    constant_step_plan,
    improved_plan,
    reconstructed,
    traditional_plan,
)

checks = partial(REGISTRY.checks, page="qiu/two_sided")
_MU = (0.0, 0.1, 1.0, 10.0, 100.0)


@checks(
    "qiu.eq11",
    rules=[
        Bounded(key="step_error", high=1e-12, label="length of a step minus alpha [rad]"),
        Bounded(key="end", high=0.0, label="joint error at the end beyond the tolerance [rad]"),
        NoOriginal(key="formula", label="the formula"),
    ],
    samples=16,
)
def next_configuration(assumed: Assumed) -> Result:
    """Steps of length alpha along the resultant until the error is below the tolerance."""
    values = nominal_values() | {k: assumed[k] for k in ("step_rule", "joint_tolerance")}
    plan = traditional_plan(values | {"gain_ratio": 1e-4})
    steps = np.linalg.norm(np.diff(plan.path, axis=0), axis=1)
    error = float(np.abs(steps - plan.problem.settings.step.length).max())
    return Result(
        obtained={
            "step_error": error,
            "end": plan.gap - assumed["joint_tolerance"],
            "searches": plan.searches,
        },
        caption=(
            f"Every step has the length alpha to {error:.0e} rad and the run ends {plan.gap:.3f} "
            "rad from "
            "its goal, below the tolerance. The printed formula is lost."
        ),
    )


def nominal_values() -> dict[str, Any]:
    """Values of all assumptions of the document."""
    return REGISTRY.nominal("qiu")


@checks(
    "qiu.eq13",
    samples=32,
    rules=[
        Bounded(
            key="difference", high=1e-9, label="steps of the forward half against the formula [rad]"
        ),
        NoOriginal(key="formula", label="the formula"),
    ],
)
def forward_update(assumed: Assumed) -> Result:
    """Every forward step, recomputed with the backward end as its goal."""
    difference = _update_difference(improved_plan(assumed), 0)
    return _update_result(difference, "forward", "backward")


@checks(
    "qiu.eq14",
    samples=32,
    rules=[
        Bounded(
            key="difference",
            high=1e-9,
            label="steps of the backward half against the formula [rad]",
        ),
        NoOriginal(key="formula", label="the formula"),
    ],
)
def backward_update(assumed: Assumed) -> Result:
    """Every backward step, recomputed with the forward end as its goal."""
    difference = _update_difference(improved_plan(assumed), 1)
    return _update_result(difference, "backward", "forward")


def _update_result(difference: float, half: str, other: str) -> Result:
    return Result(
        obtained={"difference": difference},
        caption=(
            f"Every step of the {half} half points along the resultant towards the {other} end, to "
            f"{difference:.0e} rad. The printed formula is lost with the sentence that opens step "
            "3."
        ),
    )


def _update_difference(plan: SearchPlan, side: int) -> float:
    made, half = plan.problem, plan.record.paths[side]
    other = plan.record.paths[1 - side]
    late = int(side == 1 and made.settings.order == "after")
    worst = 0.0
    for k in range(plan.searches):
        found = surroundings_at(made, side, half[k], k)
        attraction = made.settings.attraction
        pull = conic_force(
            half[k], other[k + late], attraction.gain, attraction.threshold, attraction.measure
        )
        gains = plan.record.factors[side][k] * made.settings.repulsion.gain
        force = pull + repulsive_torque(made, found, gains)
        step = half[k + 1] - half[k]
        expected = np.linalg.norm(step) * force / np.linalg.norm(force)
        worst = max(worst, float(np.abs(step - expected).max()))
    return worst


@checks(
    "qiu.eq15",
    rules=[
        Bounded(key="beyond", high=0.0, label="gap of the halves beyond the tolerance [rad]"),
        Bounded(key="earlier", low=0.0, label="smallest earlier gap above the tolerance by [rad]"),
        NoOriginal(key="tolerance", label="the tolerance"),
    ],
    samples=32,
)
def meeting_test(assumed: Assumed) -> Result:
    """The gap of the halves falls below the tolerance at the last search and not before."""
    plan = improved_plan(assumed)
    forward, backward = plan.record.paths
    gaps = np.linalg.norm(forward - backward, axis=1)
    tolerance = assumed["joint_tolerance"]
    return Result(
        obtained={
            "beyond": float(gaps[-1] - tolerance),
            "earlier": float(gaps[:-1].min() - tolerance),
            "gap_tip": float(np.linalg.norm(plan.ends[0] - plan.ends[1])),
        },
        caption=(
            f"The joint distance of the halves falls from {gaps[0]:.2f} rad to {gaps[-1]:.3f} rad; "
            "the "
            f"tips are then {1e3 * np.linalg.norm(plan.ends[0] - plan.ends[1]):.1f} mm apart, "
            "printed "
            "17.1 mm. The tolerance is not printed."
        ),
    )


@checks(
    "qiu.eq16",
    rules=[
        Bounded(key="difference", high=1e-8, label="spline against its normal equations [rad]"),
        NoOriginal(key="formula", label="the formula"),
    ],
    samples=32,
)
def smoothing_criterion(assumed: Assumed) -> Result:
    """The library's spline against a direct minimisation of the criterion."""
    path = improved_plan(nominal_values()).path
    mu, weight = assumed["smoothing_weight"], assumed["end_weight"]
    one, other = smoothed(path, mu, weight), smoothed_directly(path, mu, weight)
    return Result(
        obtained={
            "difference": float(np.abs(one - other).max()),
            "largest_change": float(np.abs(one - path).max()),
        },
        caption=(
            f"For mu = {mu:g} the smoothing spline of the library and the solution of the normal "
            f"equations agree to {np.abs(one - other).max():.0e} rad; the path changes by at most "
            f"{np.abs(one - path).max():.4f} rad. The printed formula is lost."
        ),
    )


@checks(
    "qiu.claim_mu_nonneg",
    rules=[
        Is(key="falling", value=True, label="roughness falls as mu grows"),
        Is(key="not_negative", value=True, label="mu used is not negative"),
    ],
    samples=32,
)
def smoothing_sense(assumed: Assumed) -> Result:
    """Roughness of the fitted spline over mu."""
    path = improved_plan(nominal_values()).path
    values = [roughness(smoothed_directly(path, mu, 1.0)) for mu in _MU]
    mu = assumed["smoothing_weight"]
    return Result(
        obtained={
            "falling": bool((np.diff(values) < 0).all()),
            "not_negative": bool(mu >= 0.0),
            "roughness": values,
        },
        table=pd.DataFrame({"mu": _MU, "roughness_rad2": values}),
        caption=(
            f"The roughness of the path falls from {values[0]:.2e} at mu = 0 to {values[-1]:.2e} "
            "at mu = "
            f"{_MU[-1]:g}: a larger mu smooths more, as printed. The value used is {mu:g}."
        ),
    )


@checks(
    "qiu.claim_steps_efficiency",
    rules=[
        Bounded(
            key="search_ratio",
            high=1.0,
            label="searches with adaptive over those with constant step",
        ),
    ],
    samples=32,
)
def adaptive_efficiency(assumed: Assumed) -> Result:
    """Searches with adaptive and with constant step, in both readings."""
    other = reconstructed(assumed, IMPROVED)
    pairs = {
        "face_value": (improved_plan(assumed), constant_step_plan(assumed)),
        "reconstruction": (improved_plan(other), constant_step_plan(other)),
    }
    searches = {name: [plan.searches for plan in pair] for name, pair in pairs.items()}
    relative = improved_plan(dict(_values(assumed), adaptive_step="relative"))
    face = searches["face_value"]
    return Result(
        obtained={
            "search_ratio": face[0] / face[1],
            "searches": searches,
            "relative_form": relative.searches,
            "reached": [plan.reached for plan in pairs["face_value"]],
        },
        measured={
            name: {
                "adaptive_ms": 1e3 * pair[0].record.wall_time,
                "constant_ms": 1e3 * pair[1].record.wall_time,
            }
            for name, pair in pairs.items()
        },
        caption=(
            f"Searches with adaptive and with constant step: {face[0]} and {face[1]} at face "
            "value, "
            f"{searches['reconstruction'][0]} and {searches['reconstruction'][1]} in the "
            "reconstruction. "
            "A law that never exceeds the first step can only add searches; the relative form, "
            "which "
            f"may, needs {relative.searches}."
        ),
    )


def _values(assumed: Assumed) -> dict[str, Any]:
    return {name: assumed[name] for name in IMPROVED}
