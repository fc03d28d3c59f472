"""The genetic algorithm of `pan` in ten stored runs, Figs 13-15, and what is said of one run."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import spearmanr

from .....ledger import REGISTRY, Assumed, Bounded, NoOriginal, Residual, Result
from .....ledger.captions import captions
from .....view.search_plots import best_individual_figure, history_figure, optimisers_figure
from .....welding import Evolution
from ...document import printed_optimum
from ...reading import DENSER, Genetic, Problem, denser, nothing_feasible, one_run, optimum, solved
from ...studies.evolution import Runs, stored_runs
from ...studies.optimisers import BUDGET, OPTIMISERS, TRUTH

checks = partial(REGISTRY.checks, page="pan/search")
caption = captions(__file__)
#: Draws of the assumptions for items that need a genetic run each.
_DRAWS = 16
_ON_PLANE = 1e-3  # [m], nearer to the plane of symmetry a position is its own image
_NOTHING = "No individual of the run is feasible, so there is nothing to judge."


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
    problem = Problem.of(REGISTRY.nominal("pan"))
    again, printed = problem.placement()(runs.best), printed_optimum()
    distance = np.linalg.norm(runs.best - printed, axis=1)
    return Result(
        obtained={
            "recomputed": float(abs(again - runs.fitness).max()),
            "lost": int((runs.fitness == 0).sum()),
            "gap": float(1 - runs.fitness[runs.fitness > 0].min() / optimum(problem).fitness),
            "best": runs.best[0].tolist(),
            "distance_to_printed": float(distance.min()),
        },
        table=pd.DataFrame(runs.best, columns=["x_m", "y_m", "z_m"]).assign(fitness=runs.fitness),
        caption=caption(
            "fig13", runs=runs, first=distance[0], twice=np.ptp(runs.best[:, 0]) > _ON_PLANE
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
        caption=caption("fig14", runs=len(best)),
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
    diagonal = np.linalg.norm(np.diff(Genetic.of(REGISTRY.nominal("pan")).box, axis=1))
    return Result(
        obtained={
            "outside": float(np.maximum(distance - diagonal, 0.0).max()),
            "first": float(np.median(distance[:, 0])),
            "last": float(np.median(distance[:, -1])),
        },
        table=_history_table(runs, ("distance",)),
        caption=caption("fig15", runs=len(distance)),
        alt="A falling curve of the mean distance against the generation.",
        figure=lambda: history_figure({"mean distance": distance}, "distance [m]"),
    )


def run_of(assumed: Mapping[str, Any]) -> Evolution:
    """One seeded run of the assumptions."""
    return one_run(Problem.of(assumed), Genetic.of(assumed))


@checks(
    "pan.claim_fitness_converges",
    samples=_DRAWS,
    rules=[
        Bounded("late_gain", "gain of the best fitness in the last quarter", high="flat"),
        Bounded("gap", "gap of the last best fitness to the ground truth", high="flat"),
    ],
)
def fitness_converges(assumed: Assumed) -> Result:
    """Gain of the best fitness in the last quarter of a run, and its gap to the optimum."""
    run, truth = run_of(assumed), optimum(Problem.of(assumed))
    best = np.array([generation.best for generation in run.history])
    if not run.found:
        return nothing_feasible("late_gain", "gap", told=_NOTHING)
    return Result(
        obtained={
            "late_gain": float(1 - best[3 * len(best) // 4] / best[-1]),
            "gap": float(1 - best[-1] / max(truth.fitness, best[-1])),
        },
        caption=caption("claim_fitness_converges", generations=len(best)),
    )


@checks(
    "pan.claim_distance_to_zero",
    samples=_DRAWS,
    rules=[
        Bounded("ratio", "last mean distance over the first", high="near_zero"),
        Bounded("trend", "rank correlation of the mean distance with the generation", high=0.0),
    ],
)
def distance_to_zero(assumed: Assumed) -> Result:
    """Mean distance in the last generation relative to the first, and its trend."""
    run = run_of(assumed)
    distance = np.array([generation.distance for generation in run.history])
    return Result(
        obtained={
            "ratio": float(distance[-1] / distance[0]),
            "trend": float(spearmanr(np.arange(len(distance)), distance).statistic),
        },
        caption=caption("claim_distance_to_zero", mutation=assumed["ga_mutation"]),
    )


@checks(
    "pan.claim_max_mmr",
    samples=_DRAWS,
    rules=[
        Bounded("gap", "gap of a run to the ground truth", high="three_digits"),
        Bounded(
            "violated",
            "whether a constraint is violated there, on a seam ten times as dense",
            high=0.0,
        ),
    ],
)
def largest_measure(assumed: Assumed) -> Result:
    """One run against a refined grid, and its result on a denser seam."""
    run, problem = run_of(assumed), Problem.of(assumed)
    if not run.found:
        return nothing_feasible("gap", "violated", told=_NOTHING)
    truth = max(optimum(problem).fitness, run.fitness)
    peers, told = _peers(truth)
    return Result(
        obtained={
            "gap": float(1 - run.fitness / truth),
            "violated": int(not solved(denser(problem.job), tuple(run.best)).feasible[0]),
            "truth": truth,
            "within_0.1_percent": told,
        },
        table=peers,
        caption=caption(
            "claim_max_mmr", denser=DENSER, within=told, twice=abs(run.best[0]) > _ON_PLANE
        ),
        alt="Gap to the ground truth and computing time of seven optimisers, ten runs each.",
        figure=lambda: optimisers_figure(
            OPTIMISERS.load().query("optimiser != @TRUTH"), truth, BUDGET
        ),
    )


def _peers(truth: float) -> tuple[pd.DataFrame | None, dict[str, int]]:
    """Stored runs of all optimisers, and how many come near; none for another problem."""
    table = OPTIMISERS.load()
    peers = table[table["optimiser"] != TRUTH]
    stored = float(table.loc[table["optimiser"] == TRUTH, "fitness"].iloc[0])
    if not np.isclose(stored, truth, rtol=1e-6):
        return None, {}
    hits = peers.assign(hit=peers["fitness"] >= 0.999 * stored)
    within = hits.groupby("optimiser", sort=False)["hit"].sum()
    return peers, {str(name): int(count) for name, count in within.items()}


def _history_table(runs: Runs, names: tuple[str, ...]) -> pd.DataFrame:
    columns = {
        f"{name}_run_{k}": values for name in names for k, values in enumerate(runs.histories[name])
    }
    return pd.DataFrame(columns).rename_axis("generation").reset_index()
