"""Equation (16) of `pan`, its weights and Fig. 3: the measure of all three robots."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from .....ledger import REGISTRY, Assumed, Is, NoOriginal, Residual, Result, Role
from .....ledger.captions import captions
from .....view.ellipsoids import beta_figure
from .....view.welding_cell import cell_figure
from .....welding import ROBOTS
from .....welding.ellipsoid import (
    intersection_volume,
    intersection_volume_monte_carlo,
    unit_ball_volume,
)
from .....welding.objective import ROWS, cell_grams
from ...document import SEED, stand_in
from ...print_forms import printed_text, value, worst
from ...reading import SHOWN, Job, Measure, Problem, at_display, optimum

checks = partial(REGISTRY.checks, page="pan/measure")
caption = captions(__file__)
_MILLI = 1000.0
_CASES = 20
_SAME = 1e-9


@checks(
    "pan.eq16",
    rules=[
        Residual("residual", "printed (16) and the measure used differ by", high=1e-12),
        Is(
            "one_unit",
            "by the printed (11), (15) and (16), MMR scales with one power of the length",
            value=False,
            role=Role.CONTRADICTS,
        ),
    ],
)
def system_measure(assumed: Assumed) -> Result:
    """The printed weighted mean at one position, and what a change of the unit does to it."""
    problem, (_, jobs, _) = Problem.of(assumed), at_display(assumed)
    found = problem.placement().measures(jobs)
    names = ("M_tight", "M_loose", "MMR", "beta_1", "beta_2")
    rows = np.stack(found)[:, 0].T.tolist()
    gap = worst(printed_text("pan.eq16"), [dict(zip(names, r, strict=True)) for r in rows])
    powers = unit_powers(problem.job.arm) if gap < _SAME else {}
    best = best_by_unit(problem)
    return Result(
        obtained={
            "residual": gap,
            "one_unit": bool(np.ptp(powers["MMR"]) < _SAME) if powers else None,
            "powers": {name: [min(found), max(found)] for name, found in powers.items()},
            "moved_by_unit": float(np.linalg.norm(best["m"] - best["mm"])),
            "best_in_metres": best["m"].tolist(),
            "best_in_millimetres": best["mm"].tolist(),
        },
        caption=caption("eq16"),
    )


@checks(
    "pan.fig03",
    rules=[
        Residual("fits", "extreme velocities lie on the drawn ellipsoids, to", high=1e-8),
        NoOriginal("drawing", "configuration and scale of the drawing"),
    ],
)
def three_ellipsoids(assumed: Assumed) -> Result:
    """Velocity ellipsoid of each robot at its reference point."""
    cell, jobs, centre = at_display(assumed)
    index, rows = SHOWN[assumed["display_configuration"]], ROWS[assumed["ellipsoid_space"]]
    whole = cell_grams(cell, jobs.q, rows)[:, index]
    values, vectors = np.linalg.eigh(whole)
    extreme = vectors * np.sqrt(values)[:, np.newaxis]
    on_surface = np.sum(extreme * np.linalg.solve(whole, extreme), axis=1)
    grams = whole[:, :3, :3]
    return Result(
        obtained={
            "fits": float(abs(on_surface - 1).max()),
            "semi_axes": np.sqrt(np.linalg.eigvalsh(grams))[:, ::-1].tolist(),
        },
        caption=caption("fig03", robots=ROBOTS),
        alt="Three robots, each with a translucent ellipsoid at the point where it acts.",
        figure=lambda: cell_figure(cell, jobs.q[0], centre, index=index, grams=grams),
    )


@checks(
    "pan.claim_beta_rule",
    rules=[
        Is(
            "follows_rule",
            "the weights used in (16) are the ratios of the intersection to the ellipsoids",
            value=True,
            role=Role.ADOPTS,
        )
    ],
)
def weights(assumed: Assumed) -> Result:
    """Ratios by eigenvalues and quadrature, against the weights with which (16) is computed."""
    cell, jobs, _ = at_display(assumed)
    measure = Measure.of(assumed).reading()
    used = Job.of(assumed).placement(measure).measures(jobs)
    grams = cell_grams(cell, jobs.q, 3)
    volumes = _volumes(grams)
    common = np.array([intersection_volume(grams[:, n], 2000) for n in range(cell.count)])
    weighed = cell_grams(cell, jobs.q, 6) if measure.space == "full" else grams
    ratios = common / _volumes(weighed)
    tight = _merged(measure.carriers, ratios, weighed, common)
    by_rule = tight / (tight + ratios[2])
    share = (used.beta_tight / (used.beta_tight + used.beta_loose))[0]
    gap = float(abs(share - by_rule).max())
    first, rng = grams[:, 0], np.random.default_rng(SEED)
    sampled, error = intersection_volume_monte_carlo(first, 20_000, rng)
    exact = intersection_volume(first)
    return Result(
        obtained={
            "follows_rule": gap < 1e-9,
            "gap": gap,
            "monte_carlo": abs(exact - sampled) / error,
            "volumes": volumes[:, 0].tolist(),
            "intersection": exact,
            "mean_share_of_carriers": float(share.mean()),
        },
        caption=caption("claim_beta_rule", sampled=sampled, error=error),
        alt="Volumes of three ellipsoids and of their common part, and weights along the seam.",
        figure=lambda: beta_figure(volumes, common, share),
    )


def best_by_unit(problem: Problem) -> dict[str, np.ndarray]:
    """The best position with lengths in metres and in millimetres, mirror images as one [m]."""
    measures = {unit: replace(problem.measure, length_unit=unit) for unit in ("m", "mm")}
    found = {unit: optimum(replace(problem, measure=m)) for unit, m in measures.items()}
    return {unit: np.abs(best.position) for unit, best in found.items()}


def unit_powers(arm_name: str) -> dict[str, list[float]]:
    """Powers by which the printed measures change when metres become millimetres.

    log(value in mm / value in m) / log(1000) of (11), (15) and (16) as they are printed, at random
    configurations of three robots and for random weights.
    """
    arm, rng = stand_in(arm_name), np.random.default_rng(SEED)
    single, pair, whole = (
        printed_text(f"pan.{name}").split("=")[-1] for name in ("eq11", "eq15", "eq16")
    )
    powers: dict[str, list[float]] = {"M_tight": [], "M_loose": [], "MMR": []}
    for _ in range(_CASES):
        J = arm.jacobian(arm.random_configurations(3, rng))
        beta = rng.random(2)
        found = []
        for scale in (1.0, _MILLI):
            scaled = J * np.array([scale] * 3 + [1.0] * 3)[:, np.newaxis]
            given: Mapping[str, float] = {
                "M_tight": value(pair, {"J_1": scaled[0], "J_2": scaled[1]}),
                "M_loose": value(single, {"J": scaled[2]}),
                "beta_1": beta[0],
                "beta_2": beta[1],
            }
            found.append({**given, "MMR": value(whole, given)})
        for name, entries in powers.items():
            entries.append(float(np.log(found[1][name] / found[0][name]) / np.log(_MILLI)))
    return powers


def _volumes(grams: np.ndarray) -> np.ndarray:
    """Volumes of the ellipsoids by the product of their semi-axes."""
    axes = np.sqrt(np.maximum(np.linalg.eigvalsh(grams), 0.0))
    return unit_ball_volume(grams.shape[-1]) * axes.prod(axis=-1)


def _merged(carriers: str, ratios: np.ndarray, grams: np.ndarray, common: np.ndarray) -> np.ndarray:
    """The weight of the carriers from their two ratios, as one assumption has it."""
    if carriers == "coupled_pair":
        pair = np.linalg.inv(np.linalg.inv(grams[0]) + np.linalg.inv(grams[1]))
        return common / _volumes(pair)
    return ratios[:2].sum(axis=0) * (0.5 if carriers == "mean" else 1.0)
