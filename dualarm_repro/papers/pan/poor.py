"""Two positions that are not optimal, found by stated rules: Figs 18 and 19 of `pan`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from ...ledger import REGISTRY, Assumed, Bounded, NoOriginal, Residual, Result
from ...tracking import memo
from ...view.seam_curves import measures_figure
from ...welding import WELDER, Cell, Jobs, Measures, closed_form
from ..wording import point
from .optimum import measures_at, solved
from .positions import (
    at_optimum,
    extreme_position,
    job_scene_at,
    search_box,
    status_name,
)
from .result import curve_table
from .scenario import SEED, Job, Measure, stand_in

checks = partial(REGISTRY.checks, page="pan/optimum")
#: The position of the lowest welder is the same for every reading of (16).
_ANY_MEASURE = Measure("equal", "translational", "mean", "product", "mmr", "mean", "m")


def poor_job(assumed: Mapping[str, Any], rule: str) -> tuple[Cell, Jobs, np.ndarray, Measures]:
    """The job at the position of the stated rule."""
    job, measure = Job.of(assumed), Measure.of(assumed)
    centre = extreme_position(job, measure, search_box(assumed), rule).position
    return job.cell(), solved(job, tuple(centre)), centre, measures_at(job, measure, centre)


@memo()
def largest_measure(arm: str) -> float:
    """Largest manipulability of the arm over 100 000 random configurations [m^3]."""
    model = stand_in(arm)
    q = model.random_configurations(100_000, np.random.default_rng(SEED))
    return float(closed_form(model, q).max())


def _poor_figure(item: str, letter: str, describe: Callable[..., str]) -> None:
    """Curves and scene at one of the two positions, beside the curves at the optimum."""

    @checks(
        item,
        rules=[
            Residual(
                "recomputed",
                "drawn manipulabilities and sqrt(det(J J^T)) of the joint paths differ by",
                high=1e-12,
            ),
            NoOriginal("position", "the position and the values of the curves"),
        ],
    )
    def curves(assumed: Assumed) -> Result:
        rule = assumed[f"poor_position_{letter}"]
        cell, jobs, centre, measures = poor_job(assumed, rule)
        _, best, _, best_measures = at_optimum(assumed)
        pair = ((jobs.w[0], measures), (best.w[0], best_measures))
        here, there = (w[WELDER] if letter == "a" else m.system for w, m in pair)
        panels = dict(zip((f"position ({letter})", "optimum"), pair, strict=True))
        return Result(
            obtained={
                "recomputed": recomputed(cell, jobs),
                "mean_to_optimum": float(here.mean() / there.mean()),
                "position": centre.tolist(),
            },
            table=curve_table(jobs.w[0], measures.system, assumed["time_axis"]),
            caption=(
                f"Position ({letter}), found by the stated rule: ({point(centre, 3)}) m, "
                f"{status_name(jobs)}. {describe(here)} Its mean is "
                f"{here.mean() / there.mean():.0%} of that at the optimum."
            ),
            alt=f"Manipulability curves at position ({letter}) beside those at the optimum.",
            figure=lambda: measures_figure(panels),
            scene=lambda: job_scene_at(f"The job at position ({letter}).", cell, jobs, centre),
        )


_poor_figure(
    "pan.fig18",
    "a",
    lambda w: f"The welder's manipulability lies between {w.min():.3f} and {w.max():.3f} m^3.",
)
_poor_figure(
    "pan.fig19",
    "b",
    lambda m: f"The system measure swings between {m.min():.3f} and {m.max():.3f}.",
)


@checks(
    "pan.claim_near_zero_robot3",
    rules=[
        Bounded(
            "largest_share",
            "welder's largest manipulability on the seam, as a share of the arm's largest",
            high="near_zero",
        ),
    ],
)
def near_zero(assumed: Assumed) -> Result:
    """How near to zero the welder stays on the whole seam at the poor position."""
    job, rule = Job.of(assumed), assumed["poor_position_a"]
    best = extreme_position(job, _ANY_MEASURE, search_box(assumed), rule)
    if not best.fitness:
        return Result(
            obtained={"largest_share": None, "position": None},
            caption="No position of the region is feasible, so there is no poor one either.",
        )
    jobs = solved(job, tuple(best.position))
    share = float(jobs.w[0, WELDER].max() / largest_measure(job.arm))
    return Result(
        obtained={"largest_share": share, "position": best.position.tolist()},
        caption=(
            "The text has the welder's curve near zero on the whole seam. At the poor position "
            f"found, ({point(best.position, 3)}) m, it rises to {share:.1%} of the largest "
            "manipulability of the arm somewhere on the seam, with a torch of "
            f"{job.torch_length:g} m bent by {job.torch_crank:g} deg. How low it can stay depends "
            "on the torch, whose shape and working angle are not printed."
        ),
    )


@checks(
    "pan.claim_unstable_b",
    rules=[
        Bounded(
            "swing",
            "range of the system measure along the seam over its maximum, at position (b)",
            low="unsteady",
        ),
    ],
)
def unsteady(assumed: Assumed) -> Result:
    """Variation of the system measure at position (b)."""
    job, measure = Job.of(assumed), Measure.of(assumed)
    poor = extreme_position(job, measure, search_box(assumed), assumed["poor_position_b"])
    if not poor.fitness:
        return Result(
            obtained={"swing": None, "position": None},
            caption="No position of the region is feasible, so there is no unsteady one either.",
        )
    system = measures_at(job, measure, poor.position).system
    swing = float(np.ptp(system) / system.max())
    return Result(
        obtained={"swing": swing, "position": poor.position.tolist()},
        caption=(
            f"At the least steady position, ({point(poor.position, 3)}) m, the system measure "
            f"loses {swing:.0%} of its maximum along the seam. The text connects this with "
            "unreachable points or collisions; the position found is "
            f"{status_name(solved(job, tuple(poor.position)))}."
        ),
    )


def recomputed(cell: Cell, jobs: Jobs) -> float:
    """Largest difference of the manipulabilities along the seam to those by the Jacobian."""
    return max(
        float(abs(np.abs(np.linalg.det(arm.jacobian(q))) - w).max())
        for arm, q, w in zip(cell.arms, jobs.q[0], jobs.w[0], strict=True)
    )
