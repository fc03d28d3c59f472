"""The optimum of `pan` against the printed point, and what it depends on."""

from __future__ import annotations

import json
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, Result
from .....ledger.captions import captions
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
caption = captions(__file__)
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
    table = reading_table()
    near, far = (table[[f"{reading} {radius}" for reading in READINGS]] for radius in (_NEAR, _FAR))
    shares = far.set_axis([_LABELS[reading] for reading in READINGS], axis=1)
    nearest = [(label, share.idxmax(), share.max()) for label, share in shares.items()]
    cell = problem.job.cell().unlimited()
    unlimited = Placement(cell, problem.measure.reading()).jobs([printed])
    witnesses, climbs = fitted(), searched()
    return Result(
        obtained={
            "C": best.position.tolist() if best.fitness else None,
            "distance": distance,
            "loss": loss_at_print(problem),
            "fitness": best.fitness,
            "printed_point_is": status_name(solved(problem.job, tuple(printed))),
            "readings_searched": len(climbs),
            "readings_with_witness": len(witnesses),
        },
        table=table.reset_index(),
        witnesses=witnesses,
        caption=caption(
            "claim_optimum",
            **{"near": _NEAR, "far": _FAR, "most": near.to_numpy().max(), "nearest": nearest},
            **{"witnesses": witnesses, "climbs": climbs, "met": climbs[climbs["met"]]},
            missed=climbs.loc[~climbs["met"], "distance"],
            sets=len(CONSISTENCY.load()) // len(READINGS),
        ),
        alt="Left: optima of all readings in two projections with the printed point and circles "
        "around it. Right: share of optima near the printed point for each objective and reading.",
        figure=lambda: readings_figure(_clouds(), printed, shares, (_NEAR, _FAR)),
        scene=lambda: job_scene_at(
            "The job at the printed position, joint limits left aside.", cell, unlimited, printed
        ),
    )


@memo()
def searched() -> pd.DataFrame:
    """The stored search of every reading: nearest miss, what print lacks there, evaluations, met.

    Nearest first; ``met`` where print is the optimum to the thresholds of the item.
    """
    limits = REGISTRY.look("pan.claim_optimum", "thresholds").thresholds
    table = FIT.load()
    near = table["distance"] <= limits["inside_branch"].value
    met = near & (table["loss"] <= limits["three_digits"].value)
    return table.assign(met=met).sort_values(["met", "distance"], ascending=[False, True])


def fitted() -> list[dict[str, Any]]:
    """Choices found by the stored searches under which the printed point is the optimum."""
    table = searched()
    return [
        {
            "choice": f"pan_fit {row['base_transform']}, {row['measure']}",
            "verdict": "holds",
            "values": json.loads(row["values"]),
            "judged": {"distance": float(row["distance"]), "loss": float(row["loss"])},
        }
        for _, row in table[table["met"]].iterrows()
    ]


@memo()
def reading_table() -> pd.DataFrame:
    """Share of optima near the printed point for every objective (rows) and reading of the bases.

    Columns ``<reading> 0.1`` and ``<reading> 0.15`` are shares among the sets with a feasible
    position, ``<reading> upper`` the upper end of the 95 % interval of the latter. ``<reading>
    search`` is how near the directed search came [m]; NaN where none was made.
    """
    table, climbs, printed, rows = CONSISTENCY.load(), FIT.load(), printed_optimum(), {}
    for name in OBJECTIVES:
        row = {}
        for reading in READINGS:
            distance = np.linalg.norm(_optima(table, reading, name) - printed, axis=1)
            for radius in (_NEAR, _FAR):
                row[f"{reading} {radius}"] = float((distance <= radius).mean())
            row[f"{reading} upper"] = Share.of((distance <= _FAR).sum(), len(distance)).high
            own = climbs[(climbs["base_transform"] == reading) & (climbs["measure"] == name)]
            row[f"{reading} search"] = float(own["distance"].min())
        rows[name] = row
    return pd.DataFrame.from_dict(rows, orient="index").rename_axis("objective")


def _optima(table: pd.DataFrame, reading: str, objective: str) -> np.ndarray:
    """Optima (N, 3) of the sets with a feasible position, in one reading of the bases."""
    part = table[table["base_transform"] == reading]
    return part[[f"{objective} {axis}" for axis in "xyz"]].dropna().to_numpy()


def _clouds() -> list[tuple[str, np.ndarray]]:
    """Optima of all objectives, one cloud for each reading of the bases."""
    table = CONSISTENCY.load()
    return [
        (_LABELS[reading], np.concatenate([_optima(table, reading, name) for name in OBJECTIVES]))
        for reading in READINGS
    ]


def sensitivities() -> Page:
    """The figure of the one-at-a-time study, for a page of the book."""
    table = sensitivity_table()
    nominal = table.loc[table["assumption"] == "none", ["x", "y", "z"]].to_numpy()[0]
    changed = table[table["assumption"] != "none"]
    largest: pd.Series = changed.groupby("assumption")["moved"].max().sort_values(ascending=False)
    ordered = changed.set_index("assumption").loc[largest.index].reset_index()
    told = caption(
        "sensitivities",
        largest=list(largest.items()),
        still=[name for name, moved in largest.items() if moved < 0.005],
        infeasible=int(changed["fitness"].eq(0).sum()),
        changes=len(changed),
    )
    alt = "Three panels with the coordinates of the optimum, one row for each assumption."
    figure = sensitivity_figure(ordered, nominal, printed_optimum())
    return Page(f'<div class="ledger-item">{figure_html(figure, alt, told.told({}))}</div>')
