"""Two positions that are not optimal, found by stated rules: Figs 18 and 19 of `pan`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ...ledger import REGISTRY, Assumed, Bounded, NoOriginal, Result
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
_NEAR_ZERO = 0.1  # share of the largest manipulability of the arm
_UNSTEADY = 2.0  # times the variation at the optimum
_BENT = 45  # [deg]


def poor_job(
    assumed: Mapping[str, Any], rule: str, **changes: Any
) -> tuple[Cell, Jobs, np.ndarray, Measures]:
    """The job at the position of the stated rule, some fields of the job changed."""
    job, measure = replace(Job.of(assumed), **changes), Measure.of(assumed)
    centre = extreme_position(job, measure, search_box(assumed), rule).position
    return job.cell(), solved(job, tuple(centre)), centre, measures_at(job, measure, centre)


@memo()
def largest_measure(arm: str) -> float:
    """Largest manipulability of the arm over 100 000 random configurations [m^3]."""
    model = stand_in(arm)
    q = model.random_configurations(100_000, np.random.default_rng(SEED))
    return float(closed_form(model, q).max())


def _poor_figure(item: str, letter: str, what: str, describe: Callable[..., str]) -> None:
    """Curves and scene at one of the two positions, beside the curves at the optimum."""
    assumption = f"poor_position_{letter}"

    @checks(
        item,
        rules=[
            Bounded(
                key="lower_than_optimum", high=0.9, label=f"mean of {what}, relative to the optimum"
            ),
            NoOriginal(key="position", label="the position and the values of the curves"),
        ],
    )
    def curves(assumed: Assumed) -> Result:
        cell, jobs, centre, measures = poor_job(assumed, assumed[assumption])
        _, best, _, best_measures = at_optimum(assumed)
        pair = ((jobs.w[0], measures), (best.w[0], best_measures))
        here, there = (w[WELDER] if letter == "a" else m.system for w, m in pair)
        ratio = float(here.mean() / there.mean())
        panels = dict(zip((f"position ({letter})", "optimum"), pair, strict=True))
        return Result(
            obtained={"lower_than_optimum": ratio, "position": centre.tolist()},
            table=curve_table(jobs.w[0], measures.system, assumed["time_axis"]),
            caption=(
                f"Position ({letter}), found by the stated rule: ({point(centre, 3)}) m, "
                f"{status_name(jobs)}. {describe(here)} Its mean is {ratio:.0%} of that at the "
                "optimum."
            ),
            alt=f"Manipulability curves at position ({letter}) beside those at the optimum.",
            figure=lambda: measures_figure(panels),
            scene=lambda: job_scene_at(f"The job at position ({letter}).", cell, jobs, centre),
        )


_poor_figure(
    "pan.fig18",
    "a",
    "the welder's manipulability",
    lambda w: f"The welder's manipulability lies between {w.min():.3f} and {w.max():.3f} m^3.",
)
_poor_figure(
    "pan.fig19",
    "b",
    "the system measure",
    lambda m: f"The system measure swings between {m.min():.3f} and {m.max():.3f}.",
)


@checks(
    "pan.claim_near_zero_robot3",
    rules=[
        Bounded(
            key="largest_share",
            high=_NEAR_ZERO,
            label="welder's largest manipulability on the seam, as a share of the arm's largest",
        ),
    ],
)
def near_zero(assumed: Assumed) -> Result:
    """How near to zero the welder can stay on the whole seam, with either torch."""
    _, jobs, centre, _ = poor_job(assumed, assumed["poor_position_a"])
    top = largest_measure(assumed["arm"])
    share = float(jobs.w[0, WELDER].max() / top)
    bent = poor_job(assumed, assumed["poor_position_a"], torch_crank=_BENT)[1]
    other = float(bent.w[0, WELDER].max() / top)
    return Result(
        obtained={"largest_share": share, "position": centre.tolist(), "bent_torch": other},
        caption=(
            "Close to zero is read as below a tenth of the largest manipulability of the arm. At "
            f"the lowest feasible position found the welder still rises to {share:.0%} of it "
            f"somewhere on the seam, and with a torch bent by {_BENT} deg to {other:.0%}. To stay "
            "close to zero throughout it needs a torch or a position that the document does not "
            "give."
        ),
    )


@checks(
    "pan.claim_unstable_b",
    rules=[
        Bounded(
            key="ratio",
            low=_UNSTEADY,
            label="coefficient of variation at position (b) over that at the optimum",
        ),
    ],
)
def unsteady(assumed: Assumed) -> Result:
    """Variation of the system measure at position (b) and at the optimum."""
    _, jobs, centre, measures = poor_job(assumed, assumed["poor_position_b"])
    _, _, _, best = at_optimum(assumed)
    here, there = (float(m.system.std() / m.system.mean()) for m in (measures, best))
    ratio = here / there if there > 0.0 else float("inf")
    return Result(
        obtained={
            "ratio": ratio,
            "at_b": here,
            "at_optimum": there,
            "position": centre.tolist(),
        },
        caption=(
            f"At the least steady position the system measure varies by {here:.0%} of its mean "
            f"along the seam, {ratio:.1f} times as much as at the optimum ({there:.0%}). "
            "The text connects this with unreachable points or collisions; the position found is "
            f"{status_name(jobs)}."
        ),
    )
