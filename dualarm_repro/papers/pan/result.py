"""The optimum of `pan` against the printed point, and Figs 16 and 17."""

from __future__ import annotations

import json
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import binomtest

from ...ledger import REGISTRY, Assumed, Bounded, NoOriginal, Residual, Result
from ...tracking import memo
from ...view.landscape import readings_figure
from ...view.seam_curves import joints_figure, measures_figure
from ...welding import ROBOTS, Cell, Jobs, Placement
from ..wording import point
from .consistency import CONSISTENCY, OBJECTIVES, READINGS
from .coordination import flange_poses
from .fit import FIT, loss_at_print
from .optimum import solved
from .positions import at_optimum, found_optimum, job_scene_at, status_name
from .problem import joint_margin
from .scenario import printed_optimum

checks = partial(REGISTRY.checks, page="pan/optimum")
_NEAR, _FAR = 0.10, 0.15  # [m]
_LABELS = {"inverted": "matrix as pose of the base", "literal": "matrix as labelled"}


@checks(
    "pan.claim_optimum",
    rules=[
        Bounded(
            "distance", "distance of the optimum to the printed point [m]", high="inside_branch"
        ),
        Bounded(
            "loss", "share of the best measure that the printed point lacks", high="three_digits"
        ),
    ],
)
def printed_point(assumed: Assumed) -> Result:
    """Distance of the optimum to the printed point, and choices that bring it there."""
    job, measure, best = found_optimum(assumed)
    printed = printed_optimum()
    distance = float(np.linalg.norm(best.position - printed)) if best.fitness else None
    lost = loss_at_print(job, measure, best.fitness)
    at_print = solved(job, tuple(printed))
    table = reading_table()
    near, far = (table[[f"{reading} {radius}" for reading in READINGS]] for radius in (_NEAR, _FAR))
    shares = far.set_axis([_LABELS[reading] for reading in READINGS], axis=1)
    told = "; ".join(
        f"with the {column} '{shares[column].idxmax()}' comes nearest, "
        f"{shares[column].max():.1%} of its optima"
        for column in shares
    )
    sets = len(CONSISTENCY.load()) // len(READINGS)
    cell = job.cell().unlimited()
    unlimited = Placement(cell, measure.reading()).jobs([printed])
    witnesses = fitted()
    return Result(
        obtained={
            "C": best.position.tolist() if best.fitness else None,
            "distance": distance,
            "loss": lost,
            "fitness": best.fitness,
            "printed_point_is": status_name(at_print),
        },
        table=table.reset_index(),
        witnesses=witnesses,
        caption=_told_optimum(best.position, distance, lost, status_name(at_print))
        + _told_fit(witnesses)
        + (
            f" Over {sets} sampled sets of assumptions, and within {_FAR:g} m of the printed "
            f"point: {told}. The largest share within {_NEAR:g} m is {near.to_numpy().max():.1%}."
        ),
        alt=(
            "Left: optima of all readings in two projections with the printed point and circles "
            "around it. Right: share of optima near the printed point for each objective and "
            "reading."
        ),
        figure=lambda: readings_figure(_clouds(), printed, shares, (_NEAR, _FAR)),
        scene=lambda: job_scene_at(
            "The job at the printed position, joint limits left aside.", cell, unlimited, printed
        ),
    )


@memo()
def fitted() -> list[dict[str, Any]]:
    """Choices found by the stored search under which the printed point is the optimum."""
    limits = REGISTRY.look("pan.claim_optimum", "thresholds").thresholds
    table = FIT.load()
    met = (table["distance"] <= limits["inside_branch"].value) & (
        table["loss"] <= limits["three_digits"].value
    )
    return [
        {
            "choice": f"pan_fit {row['start']}",
            "verdict": "holds",
            "values": json.loads(row["values"]),
            "judged": {"distance": float(row["distance"]), "loss": float(row["loss"])},
        }
        for _, row in table[met].sort_values("distance").iterrows()
    ]


def _told_optimum(C: np.ndarray, distance: float | None, lost: float, status: str) -> str:
    if distance is None:
        return "No position of the region is feasible."
    there = "not feasible there" if lost >= 1 else f"{lost:.2%} below it"
    return (
        f"With these assumptions the best position is ({point(C, 3)}) m, {distance:.2f} m from the "
        f"printed one, which is {there} ({status})."
    )


def _told_fit(witnesses: list[dict[str, Any]]) -> str:
    if not witnesses:
        return f" Of {len(FIT.load())} directed searches none found a choice that gives it."
    best = witnesses[0]
    told = ", ".join(
        f"{key.replace('_', ' ')} {value if isinstance(value, str) else format(value, '.3g')}"
        for key, value in best["values"].items()
    )
    return (
        f" Of {len(FIT.load())} directed searches {len(witnesses)} found a choice that gives it: "
        f"with {told} the optimum is {best['judged']['distance']:.3f} m from it and "
        f"{best['judged']['loss']:.2%} better. That shows a possibility, not the origin."
    )


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
    _, measure, best = found_optimum(assumed)
    _, jobs, _, measures = at_optimum(assumed)
    w = jobs.w[0]
    return Result(
        obtained={
            "aggregated": float(abs(measure.reading().aggregate(measures.system) - best.fitness)),
            "smallest": float(w.min()),
            "range": [float(measures.system.min()), float(measures.system.max())],
        },
        table=curve_table(w, measures.system, assumed["time_axis"]),
        caption=(
            f"At the optimum the system measure stays between {measures.system.min():.3f} and "
            f"{measures.system.max():.3f}; the welder's lies between {w[2].min():.3f} and "
            f"{w[2].max():.3f} m^3, since in the flat position it hardly moves. Values of the "
            "printed curves are not known, nor which measures they show."
        ),
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
    closing = q[:, -1] + np.round((q[:, 0] - q[:, -1]) / (2 * np.pi)) * 2 * np.pi
    span = np.degrees(np.ptp(q, axis=1))
    columns = {
        f"{name} q{j + 1}": np.degrees(q[k, :, j])
        for k, name in enumerate(ROBOTS)
        for j in range(6)
    }
    margin = joint_margin(cell, jobs)
    return Result(
        obtained={
            "carried": _carried(cell, jobs, centre),
            "turns": float(np.round(abs(closing - q[:, -1]) / (2 * np.pi)).max()),
            "joint_margin": margin,
            "span_deg": span.tolist(),
            "branches": jobs.branch[0].tolist(),
        },
        table=pd.DataFrame(columns).rename_axis(assumed["time_axis"]).reset_index(),
        caption=(
            "Joint paths at the optimum, each on one branch, closed after one turn and at least "
            f"{margin:.1f} deg within limits. The carriers' joints sweep up to "
            f"{span[:2].max():.0f} deg, the welder's {span[2, :5].max():.0f} deg."
        ),
        alt="Six joint angles of each of three robots along the seam, smooth and periodic.",
        figure=lambda: joints_figure(cell, q),
    )


def _carried(cell: Cell, jobs: Jobs, centre: np.ndarray) -> float:
    """Largest difference of the flange poses by forward kinematics to those of the job."""
    worst = 0.0
    for robot in range(len(ROBOTS)):
        wanted = cell.flanges[robot].copy()
        wanted[:, :3, 3] += centre
        worst = max(worst, float(abs(flange_poses(cell, jobs, robot) - wanted).max()))
    return worst


@memo()
def reading_table() -> pd.DataFrame:
    """Share of optima near the printed point for every objective (rows) and reading of the bases.

    Columns ``<reading> 0.1`` and ``<reading> 0.15`` are shares among the sets with a feasible
    position, ``<reading> upper`` the upper end of the 95 % interval of the latter.
    """
    table, printed = CONSISTENCY.load(), printed_optimum()
    rows = {}
    for name in OBJECTIVES:
        row = {}
        for reading in READINGS:
            part = table[table["base_transform"] == reading]
            points = part[[f"{name} {axis}" for axis in "xyz"]].dropna().to_numpy()
            distance = np.linalg.norm(points - printed, axis=1)
            for radius in (_NEAR, _FAR):
                row[f"{reading} {radius}"] = float((distance <= radius).mean())
            hits = int((distance <= _FAR).sum())
            interval = binomtest(hits, len(distance)).proportion_ci(method="wilson")
            row[f"{reading} upper"] = float(interval.high)
        rows[name] = row
    return pd.DataFrame.from_dict(rows, orient="index").rename_axis("objective")


def _clouds() -> list[tuple[str, np.ndarray]]:
    """Optima of all objectives, one cloud for each reading of the bases."""
    table = CONSISTENCY.load()
    clouds = []
    for reading in READINGS:
        part = table[table["base_transform"] == reading]
        points = [part[[f"{name} {axis}" for axis in "xyz"]].dropna() for name in OBJECTIVES]
        clouds.append((_LABELS[reading], np.concatenate(points)))
    return clouds


def curve_table(w: np.ndarray, system: np.ndarray, axis: str) -> pd.DataFrame:
    """Manipulabilities of the robots and the system measure against the seam point."""
    columns = {f"{name}_m3": values for name, values in zip(ROBOTS, w, strict=True)}
    return pd.DataFrame({**columns, "system": system}).rename_axis(axis).reset_index()
