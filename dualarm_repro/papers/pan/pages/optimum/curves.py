"""Curves along the seam at the optimum of `pan` and at two poor positions: Figs 16-19."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, NoOriginal, Residual, Result
from .....ledger.captions import captions
from .....tracking import memo
from .....view.seam_curves import joints_figure, measures_figure
from .....welding import ROBOTS, WELDER, Cell, Jobs, closed_form, flange_poses, joint_margin
from .....welding.motion import stretch
from ...document import SEED, stand_in
from ...reading import (
    Measure,
    Problem,
    at_optimum,
    job_scene_at,
    measures_at,
    nothing_feasible,
    optimum,
    poor_position,
    solved,
    status_name,
)

checks = partial(REGISTRY.checks, page="pan/optimum")
caption = captions(__file__)
#: The position of the lowest welder is the same for every reading of (16).
_ANY_MEASURE = Measure("equal", "translational", "mean", "product", "mmr", "mean", "m")


@checks(
    "pan.fig16",
    rules=[
        Residual(
            "aggregated",
            "the drawn system measure, aggregated, and the fitness of the optimum differ by",
            high=1e-12,
        ),
        NoOriginal("values", "values of the curves"),
    ],
)
def optimal_curves(assumed: Assumed) -> Result:
    """Measures along the seam at the optimum."""
    problem, (_, jobs, _, measures) = Problem.of(assumed), at_optimum(assumed)
    aggregated, w = problem.measure.reading().aggregate(measures.system), jobs.w[0]
    return Result(
        obtained={
            "aggregated": float(abs(aggregated - optimum(problem).fitness)),
            "smallest": float(w.min()),
            "range": [float(measures.system.min()), float(measures.system.max())],
        },
        table=curve_table(w, measures.system, assumed["time_axis"]),
        caption=caption("fig16", w=w[WELDER]),
        alt="Manipulability of three robots and of the system along the seam, well above zero.",
        figure=lambda: measures_figure({"at the optimum": (w, measures)}),
    )


@checks(
    "pan.fig17",
    rules=[
        Residual(
            "carried",
            "flange poses of the drawn joint angles and those of the job differ by",
            high=1e-9,
        ),
        Bounded("turns", "full turns by which a joint fails to come back", high=0.0),
        NoOriginal("values", "values of the curves"),
    ],
)
def joint_curves(assumed: Assumed) -> Result:
    """Joint angles along the seam at the optimum."""
    cell, jobs, centre, _ = at_optimum(assumed)
    q = jobs.q[0]
    turns = np.round((q[:, 0] - q[:, -1]) / (2 * np.pi))
    span = np.degrees(np.ptp(q, axis=1))
    columns = {
        f"{name} q{j + 1}": np.degrees(q[k, :, j])
        for k, name in enumerate(ROBOTS)
        for j in range(6)
    }
    return Result(
        obtained={
            "carried": _carried(cell, jobs, centre),
            "turns": float(abs(turns).max()),
            "joint_margin": float(np.degrees(joint_margin(cell, jobs))),
            "span_deg": span.tolist(),
            "branches": jobs.branch[0].tolist(),
        },
        table=pd.DataFrame(columns).rename_axis(assumed["time_axis"]).reset_index(),
        caption=caption("fig17"),
        alt="Six joint angles of each of three robots along the seam, smooth and periodic.",
        figure=lambda: joints_figure(cell, q),
    )


@memo()
def largest_measure(arm: str) -> float:
    """Largest manipulability of the arm over 100 000 random configurations [m^3]."""
    model = stand_in(arm)
    q = model.random_configurations(100_000, np.random.default_rng(SEED))
    return float(closed_form(model, q).max())


def _poor_figure(item: str, letter: str) -> None:
    """Curves and scene at one of the two positions, beside the curves at the optimum."""

    @checks(
        f"pan.{item}",
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
        problem = Problem.of(assumed)
        centre = poor_position(problem, assumed[f"poor_position_{letter}"]).position
        cell, jobs = problem.job.cell(), solved(problem.job, tuple(centre))
        measures = measures_at(problem, centre)
        _, best, _, best_measures = at_optimum(assumed)
        pair = ((jobs.w[0], measures), (best.w[0], best_measures))
        here, there = (w[WELDER] if letter == "a" else m.system for w, m in pair)
        panels = dict(zip((f"position ({letter})", "optimum"), pair, strict=True))
        return Result(
            obtained={
                "recomputed": _recomputed(cell, jobs),
                "mean_to_optimum": float(here.mean() / there.mean()),
                "position": centre.tolist(),
            },
            table=curve_table(jobs.w[0], measures.system, assumed["time_axis"]),
            caption=caption(item, status=status_name(jobs), curve=here, cusp=_cusp(cell, jobs)),
            alt=f"Manipulability curves at position ({letter}) beside those at the optimum.",
            figure=lambda: measures_figure(panels),
            scene=lambda: job_scene_at(f"The job at position ({letter}).", cell, jobs, centre),
        )


_poor_figure("fig18", "a")
_poor_figure("fig19", "b")


@checks(
    "pan.claim_near_zero_robot3",
    rules=[
        Bounded(
            "largest_share",
            "welder's largest manipulability on the seam, as a share of the arm's largest",
            high="near_zero",
        )
    ],
)
def near_zero(assumed: Assumed) -> Result:
    """How near to zero the welder stays on the whole seam at the poor position."""
    problem = Problem.of(assumed, _ANY_MEASURE)
    job, best = problem.job, poor_position(problem, assumed["poor_position_a"])
    if not best.fitness:
        return nothing_feasible("largest_share", "position")
    jobs = solved(job, tuple(best.position))
    share = float(jobs.w[0, WELDER].max() / largest_measure(job.arm))
    return Result(
        obtained={"largest_share": share, "position": best.position.tolist()},
        caption=caption("claim_near_zero_robot3", job=job),
    )


@checks(
    "pan.claim_unstable_b",
    rules=[
        Bounded(
            "swing",
            "range of the system measure along the seam over its maximum, at position (b)",
            low="unsteady",
        )
    ],
)
def unsteady(assumed: Assumed) -> Result:
    """Variation of the system measure at position (b)."""
    problem = Problem.of(assumed)
    poor = poor_position(problem, assumed["poor_position_b"])
    if not poor.fitness:
        return nothing_feasible("swing", "position")
    system = measures_at(problem, poor.position).system
    return Result(
        obtained={
            "swing": float(np.ptp(system) / system.max()),
            "position": poor.position.tolist(),
        },
        caption=caption(
            "claim_unstable_b", status=status_name(solved(problem.job, tuple(poor.position)))
        ),
    )


def _cusp(cell: Cell, jobs: Jobs) -> dict[str, Any]:
    """Where the welder comes nearest to a singularity, and how far its arm is stretched there."""
    point = int(jobs.w[0, WELDER].argmin())
    return {"point": point, "stretch": float(stretch(cell, jobs, WELDER)[point])}


def curve_table(w: np.ndarray, system: np.ndarray, axis: str) -> pd.DataFrame:
    """Manipulabilities of the robots and the system measure against the seam point."""
    columns = {f"{name}_m3": values for name, values in zip(ROBOTS, w, strict=True)}
    return pd.DataFrame({**columns, "system": system}).rename_axis(axis).reset_index()


def _carried(cell: Cell, jobs: Jobs, centre: np.ndarray) -> float:
    """Largest difference of the flange poses by forward kinematics to those of the job."""
    wanted, robots = cell.flanges.copy(), range(len(ROBOTS))
    wanted[..., :3, 3] += centre
    return float(abs([flange_poses(cell, jobs, robot) for robot in robots] - wanted).max())


def _recomputed(cell: Cell, jobs: Jobs) -> float:
    """Largest difference of the manipulabilities along the seam to those by the Jacobian."""
    return max(
        float(abs(np.abs(np.linalg.det(arm.jacobian(q))) - w).max())
        for arm, q, w in zip(cell.arms, jobs.q[0], jobs.w[0], strict=True)
    )
