"""The optimum of `pan` against the printed point, and what it depends on."""

from __future__ import annotations

import json
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, Result
from .....ledger.captions import point
from .....ledger.shares import Share
from .....tracking import memo
from .....view.card import figure_html
from .....view.landscape import readings_figure, sensitivity_figure
from .....view.page import Page
from .....welding import Placement
from ...document import printed_optimum
from ...reading import Problem, job_scene_at, optimum, solved, status_name
from ...studies.consistency import CONSISTENCY, OBJECTIVES, READINGS
from ...studies.fit import FIT, loss_at_print
from ...studies.sensitivity import sensitivity_table

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
    problem, printed = Problem.of(assumed), printed_optimum()
    best = optimum(problem)
    distance = float(np.linalg.norm(best.position - printed)) if best.fitness else None
    lost = loss_at_print(problem)
    at_print = solved(problem.job, tuple(printed))
    table = reading_table()
    near, far = (table[[f"{reading} {radius}" for reading in READINGS]] for radius in (_NEAR, _FAR))
    shares = far.set_axis([_LABELS[reading] for reading in READINGS], axis=1)
    told = "; ".join(
        f"with the {column} '{shares[column].idxmax()}' comes nearest, "
        f"{shares[column].max():.1%} of its optima"
        for column in shares
    )
    sets = len(CONSISTENCY.load()) // len(READINGS)
    cell = problem.job.cell().unlimited()
    unlimited = Placement(cell, problem.measure.reading()).jobs([printed])
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
            row[f"{reading} upper"] = Share.of((distance <= _FAR).sum(), len(distance)).high
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


def sensitivities() -> Page:
    """The figure of the one-at-a-time study, for a page of the book."""
    table = sensitivity_table()
    nominal = table.loc[table["assumption"] == "none", ["x", "y", "z"]].to_numpy()[0]
    changed = table[table["assumption"] != "none"]
    largest: pd.Series = changed.groupby("assumption")["moved"].max().sort_values(ascending=False)
    ordered = changed.set_index("assumption").loc[largest.index].reset_index()
    still = [name for name, moved in largest.items() if moved < 0.005]
    infeasible = int(changed["fitness"].eq(0).sum())
    leading = ", ".join(
        f"{str(name).replace('_', ' ')} ({moved:.2f} m)" for name, moved in largest.head(4).items()
    )
    caption = (
        "Optimum when one assumption at a time takes other plausible values. It moves most with "
        f"{leading}. It does not move with "
        f"{', '.join(str(name).replace('_', ' ') for name in still) or 'none'}. {infeasible} of "
        f"{len(changed)} changes leave no feasible position."
    )
    alt = "Three panels with the coordinates of the optimum, one row for each assumption."
    figure = sensitivity_figure(ordered, nominal, printed_optimum())
    return Page(f'<div class="ledger-item">{figure_html(figure, alt, caption)}</div>')
