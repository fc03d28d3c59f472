"""Figs 13-15 of `pan`: the genetic algorithm in ten stored runs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, NoOriginal, Residual, Result
from ...view.search_plots import best_individual_figure, history_figure
from ...welding import genetic
from ..wording import point
from .nominal import nominal_values
from .positions import found_optimum, search_box
from .scenario import printed_optimum
from .studies import EVOLUTION

checks = partial(REGISTRY.checks, page="pan/search")


@dataclass(frozen=True)
class Runs:
    """Outcomes of several seeded runs.

    Best (R, 3), fitness (R,), generation and rule at which each ended, histories (R, G) that are
    held at their last value after the run has ended.
    """

    best: np.ndarray
    fitness: np.ndarray
    ends: list[tuple[int, str]]
    histories: dict[str, np.ndarray]


@checks(
    "pan.fig13",
    rules=[
        Residual(
            "recomputed",
            "fitness of the drawn positions and that which the runs reported differ by",
            high=1e-12,
        ),
        NoOriginal("settings", "the settings of the genetic algorithm and of the problem"),
    ],
)
def best_individual(assumed: Assumed) -> Result:
    """Best individual of every run."""
    runs = stored_runs(round(assumed["ga_seeds"]))
    job, measure, truth = found_optimum(nominal_values())
    again = job.placement(measure.reading())(runs.best)
    gap = float(1 - runs.fitness.min() / truth.fitness)
    printed = printed_optimum()
    distance = np.linalg.norm(runs.best - printed, axis=1)
    return Result(
        obtained={
            "recomputed": float(abs(again - runs.fitness).max()),
            "gap": gap,
            "best": runs.best[0].tolist(),
            "distance_to_printed": float(distance.min()),
        },
        table=pd.DataFrame(runs.best, columns=["x_m", "y_m", "z_m"]).assign(fitness=runs.fitness),
        caption=(
            f"All {len(runs.best)} runs come within {100 * gap:.3f} % of the ground truth. Which "
            "of two mirror images they return is chance, and x scatters most, since the fitness "
            f"is flat along it. The first run ends at ({point(runs.best[0], 3)}) m, "
            f"{distance[0]:.2f} m from the printed point."
        ),
        alt="Bars of the three coordinates of the best individual beside the printed coordinates.",
        figure=lambda: best_individual_figure(runs.best, printed),
    )


@checks(
    "pan.fig14",
    rules=[
        Residual(
            "end",
            "end of the upper curve and the fitness of the best individual differ by",
            high=1e-12,
        ),
        Bounded("mean_above_best", "how far a mean lies above its best value", high=0.0),
        NoOriginal("values", "fitness values and settings"),
    ],
)
def fitness_curves(assumed: Assumed) -> Result:
    """Best and mean fitness over the generations."""
    runs = stored_runs(round(assumed["ga_seeds"]))
    best, mean = runs.histories["best"], runs.histories["mean"]
    return Result(
        obtained={
            "end": float(abs(best[:, -1] - runs.fitness).max()),
            "mean_above_best": float(np.maximum(mean - best, 0.0).max()),
            "best_last": float(np.median(best[:, -1])),
            "mean_last": float(np.median(mean[:, -1])),
        },
        table=_history_table(runs, ("best", "mean")),
        caption=(
            f"Best and mean fitness of {len(best)} runs (median, band of all). The best settles "
            f"at {np.median(best[:, -1]):.3f}; the mean, in which infeasible individuals count as "
            f"0, ends at {np.median(mean[:, -1]):.3f}. It rises late because the mutations shrink "
            "to nothing by the last generation. No value of the printed curves is known."
        ),
        alt="Two rising curves against the generation; the upper one is flat for most of the run.",
        figure=lambda: history_figure({"best": best, "mean": mean}, "fitness"),
    )


@checks(
    "pan.fig15",
    rules=[
        Bounded(
            "outside", "how far a mean distance exceeds the diagonal of the region [m]", high=0.0
        ),
        NoOriginal("values", "distances and settings"),
    ],
)
def distance_curve(assumed: Assumed) -> Result:
    """Mean distance between individuals over the generations."""
    runs = stored_runs(round(assumed["ga_seeds"]))
    distance = runs.histories["distance"]
    diagonal = float(np.linalg.norm(np.diff(np.array(search_box(nominal_values())), axis=1)))
    return Result(
        obtained={
            "outside": float(np.maximum(distance - diagonal, 0.0).max()),
            "first": float(np.median(distance[:, 0])),
            "last": float(np.median(distance[:, -1])),
        },
        table=_history_table(runs, ("distance",)),
        caption=(
            f"Mean distance between the individuals of {len(distance)} runs: from "
            f"{np.median(distance[:, 0]):.2f} m to {np.median(distance[:, -1]):.3f} m (medians)."
        ),
        alt="A falling curve of the mean distance against the generation.",
        figure=lambda: history_figure({"mean distance": distance}, "distance [m]"),
    )


def stored_runs(count: int, variant: str = "declared") -> Runs:
    """The first ``count`` stored runs on the declared problem."""
    table = EVOLUTION.load()
    table = table[table["variant"] == variant].head(count)

    def history(name: str) -> np.ndarray:
        columns = [column for column in table.columns if column.rpartition("_")[0] == name]
        return table[columns].to_numpy()

    return Runs(
        table[["x", "y", "z"]].to_numpy(),
        table["fitness"].to_numpy(),
        list(zip(table["generations"].tolist(), table["reason"], strict=True)),
        {name: history(name) for name in genetic.Generation._fields},
    )


def _history_table(runs: Runs, names: tuple[str, ...]) -> pd.DataFrame:
    columns = {
        f"{name}_run_{k}": values for name in names for k, values in enumerate(runs.histories[name])
    }
    return pd.DataFrame(columns).rename_axis("generation").reset_index()
