"""The genetic algorithm of `pan`: Figs 11 and 13-15 and what the text says of its runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from ...view.flow_chart import flow_chart
from ...view.search_plots import best_individual_figure, history_figure, optimisers_figure
from ...welding import genetic
from ..wording import point
from .nominal import nominal_values
from .optimum import solved
from .positions import found_optimum, search_box
from .scenario import SEED, Genetic, Job, Measure, printed_optimum
from .studies import BUDGET, EVOLUTION, OPTIMISERS, TRUTH

checks = partial(REGISTRY.checks, page="pan/search")
_LIVE_RUNS = 2  # where the stored runs do not apply
_NAMED = ("fitness", "constraint", "elite", "cross", "mutate", "generation limit", "mean fitness")


@dataclass(frozen=True)
class Runs:
    """Outcomes of several seeded runs: best (R, 3), fitness (R,), histories (R, G)."""

    best: np.ndarray
    fitness: np.ndarray
    reasons: list[str]
    histories: dict[str, np.ndarray]


def runs_of(assumed: Mapping[str, Any]) -> Runs:
    """The stored runs for the declared assumptions; a few live ones for any others."""
    job, measure, settings = Job.of(assumed), Measure.of(assumed), Genetic.of(assumed)
    box, count = search_box(assumed), round(assumed["ga_seeds"])
    declared = nominal_values()
    if (job, measure, settings, box) == (
        Job.of(declared),
        Measure.of(declared),
        Genetic.of(declared),
        search_box(declared),
    ):
        return _stored("declared", count)
    placement = job.placement(measure.reading())
    found = [
        genetic.evolve(
            placement,
            np.array(box),
            settings.settings(),
            np.random.default_rng(seed),
            must_find=False,
        )
        for seed in np.random.SeedSequence(SEED).spawn(min(count, _LIVE_RUNS))
    ]
    last = max(len(run.history) for run in found)
    held = [[*run.history, *[run.history[-1]] * (last - len(run.history))] for run in found]
    return Runs(
        np.array([run.best for run in found]),
        np.array([run.fitness for run in found]),
        [run.reason for run in found],
        {
            name: np.array([[getattr(g, name) for g in run] for run in held])
            for name in genetic.Generation._fields
        },
    )


@checks(
    "pan.fig11",
    samples=32,
    rules=[
        Is(
            key="named_steps",
            value=len(_NAMED),
            label="steps named in the text that the loop contains",
        ),
        NoOriginal(key="chart", label="the content of the chart"),
    ],
)
def chart(assumed: Assumed) -> Result:
    """Drawn from the list of functions that the search runs."""
    settings = Genetic.of(assumed).settings()
    elite, crossed, mutants = settings.counts
    steps = [genetic.initialise, *genetic.LOOP]
    text = " ".join((step.__doc__ or "").lower() for step in steps)
    return Result(
        obtained={
            "named_steps": sum(word in text for word in _NAMED),
            "steps": [step.__name__ for step in steps],
        },
        caption=(
            f"The loop that is run, drawn from its own functions. Of {settings.population} "
            f"individuals {elite} pass on unchanged, {crossed} come from crossover and {mutants} "
            f"from mutation ({settings.mutation.replace('_', ' ')}). The content of the printed "
            "chart is not in the text edition."
        ),
        alt="Flow chart: draw, evaluate, rank, decide, select, reproduce, and back to evaluate.",
        figure=lambda: flow_chart(genetic.initialise, genetic.LOOP, genetic.finished),
    )


@checks(
    "pan.fig13",
    rules=[
        Bounded(key="gap", high=1e-3, label="largest gap of the runs to the ground truth"),
        NoOriginal(
            key="settings", label="the settings of the genetic algorithm and of the problem"
        ),
    ],
)
def best_individual(assumed: Assumed) -> Result:
    """Best individual of every run."""
    runs, (_, _, truth) = runs_of(assumed), found_optimum(assumed)
    gap = float(1 - runs.fitness.min() / truth.fitness)
    printed = printed_optimum()
    distance = np.linalg.norm(runs.best - printed, axis=1)
    return Result(
        obtained={
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
        Is(key="never_falls", value=True, label="the best fitness never falls"),
        NoOriginal(key="values", label="fitness values and settings"),
    ],
)
def fitness_curves(assumed: Assumed) -> Result:
    """Best and mean fitness over the generations."""
    runs = runs_of(assumed)
    best, mean = runs.histories["best"], runs.histories["mean"]
    return Result(
        obtained={
            "never_falls": _never_falls(best),
            "best_last": float(np.median(best[:, -1])),
            "mean_last": float(np.median(mean[:, -1])),
        },
        table=_history_table(runs, ("best", "mean")),
        caption=(
            f"Best and mean fitness of {len(best)} runs (median, band of all). The best settles "
            f"at {np.median(best[:, -1]):.3f}; the mean, in which infeasible individuals count as "
            f"0, ends at {np.median(mean[:, -1]):.3f}. No value of the printed curves is known."
        ),
        alt="Two rising curves against the generation; the upper one is flat for most of the run.",
        figure=lambda: history_figure({"best": best, "mean": mean}, "fitness"),
    )


@checks(
    "pan.fig15",
    rules=[
        Bounded(
            key="largest_last", high=0.5, label="largest mean distance in the last generation [m]"
        ),
        NoOriginal(key="values", label="distances and settings"),
    ],
)
def distance_curve(assumed: Assumed) -> Result:
    """Mean distance between individuals over the generations."""
    runs = runs_of(assumed)
    distance = runs.histories["distance"]
    return Result(
        obtained={
            "largest_last": float(distance[:, -1].max()),
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


@checks(
    "pan.claim_fitness_converges",
    rules=[
        Is(key="never_falls", value=True, label="the best fitness never falls"),
        Bounded(key="late_gain", high=0.01, label="gain of the best fitness in the last quarter"),
    ],
)
def fitness_converges(assumed: Assumed) -> Result:
    """Gain of the best fitness in the last quarter of the generations."""
    best = runs_of(assumed).histories["best"]
    start = best[:, 3 * best.shape[1] // 4]
    gain = float((1 - start / best[:, -1]).max())
    return Result(
        obtained={"never_falls": _never_falls(best), "late_gain": gain},
        caption=(
            f"In each of {len(best)} runs the best fitness never falls, and in the last quarter "
            f"of the generations it gains {gain:.2%} at most: it has converged."
        ),
    )


@checks(
    "pan.claim_distance_to_zero",
    rules=[
        Bounded(
            key="ratio", high=0.1, label="last mean distance over the first, largest of all runs"
        ),
    ],
)
def distance_to_zero(assumed: Assumed) -> Result:
    """Mean distance in the last generation relative to the first."""
    declared = runs_of(assumed).histories["distance"]
    adaptive = _stored("adaptive mutation", len(declared)).histories["distance"]
    ratio, other = (float((d[:, -1] / d[:, 0]).max()) for d in (declared, adaptive))
    return Result(
        obtained={"ratio": ratio, "ratio_adaptive_mutation": other},
        caption=(
            f"The mean distance falls to {ratio:.1%} of its first value at most. It keeps a "
            "remainder, because mutants are drawn until the end; with mutation that adapts its "
            f"step it falls to {other:.2%}. Both are small against the region, so the statement "
            "holds in its sense."
        ),
    )


@checks(
    "pan.claim_ga_stop",
    rules=[
        Is(key="both_end_runs", value=True, label="each of the two rules ends some run"),
        NoOriginal(key="thresholds", label="generation number and smallest change"),
    ],
)
def two_stop_rules(assumed: Assumed) -> Result:
    """Which rule ended the runs of each variant."""
    declared = runs_of(assumed)
    counts = {"declared": _counts(declared.reasons)}
    for variant in ("adaptive mutation", "coarse stall"):
        counts[variant] = _counts(_stored(variant, len(declared.reasons)).reasons)
    ended = {reason for found in counts.values() for reason, n in found.items() if n}
    told = "; ".join(
        f"{name}: {found['generations']} by the limit, {found['stall']} by the stall"
        for name, found in counts.items()
    )
    return Result(
        obtained={"both_end_runs": ended == {"generations", "stall"}, "counts": counts},
        caption=(
            f"Runs ended by either rule: {told}. With mutation that keeps drawing, the mean "
            "fitness never rests, so that the second rule depends on an operator and a threshold "
            "that are not printed."
        ),
    )


@checks(
    "pan.claim_discard",
    rules=[
        Bounded(key="first", low=0.5, label="smallest infeasible share of a first generation"),
        Bounded(key="best_infeasible", high=0.0, label="runs whose best individual is infeasible"),
    ],
)
def discarded(assumed: Assumed) -> Result:
    """Share of infeasible individuals over the generations."""
    runs = runs_of(assumed)
    share = 1 - runs.histories["feasible"]
    return Result(
        obtained={
            "first": float(share[:, 0].min()),
            "last": float(np.median(share[:, -1])),
            "best_infeasible": int((runs.fitness <= 0).sum()),
        },
        caption=(
            f"Of the first generation {np.median(share[:, 0]):.0%} violate a constraint, of the "
            f"last {np.median(share[:, -1]):.0%} (medians). With fitness 0 they drop out by "
            "themselves; no run was lost."
        ),
        alt="Share of infeasible individuals against the generation, falling from nearly one.",
        figure=lambda: history_figure({"infeasible": share}, "share of the generation"),
    )


@checks(
    "pan.claim_max_mmr",
    rules=[
        Bounded(key="gap", high=1e-3, label="largest gap of the declared runs to the ground truth"),
        Is(key="all_limits_met", value=True, label="the best individual meets every constraint"),
    ],
)
def largest_measure(assumed: Assumed) -> Result:
    """The genetic algorithm and other optimisers against a refined dense grid."""
    runs, (job, _, best) = runs_of(assumed), found_optimum(assumed)
    table = OPTIMISERS.load()
    truth = max(float(table.loc[table["optimiser"] == TRUTH, "fitness"].iloc[0]), best.fitness)
    gap = float(1 - runs.fitness.min() / truth)
    chosen = tuple(runs.best[runs.fitness.argmax()])
    peers = table[table["optimiser"] != TRUTH]
    within = (
        peers.assign(hit=peers["fitness"] >= 0.999 * truth)
        .groupby("optimiser", sort=False)["hit"]
        .sum()
    )
    return Result(
        obtained={
            "gap": gap,
            "all_limits_met": bool(solved(job, chosen).feasible[0]),
            "within_0.1_percent": {name: int(count) for name, count in within.items()},
            "truth": truth,
        },
        table=peers,
        caption=(
            f"The genetic algorithm comes within {100 * gap:.3f} % of the ground truth in every "
            "run and meets every constraint there. With the same number of evaluations "
            "0.1 % is reached in "
            + ", ".join(f"{count} ({name})" for name, count in within.items())
            + " of ten runs: the algorithm is adequate, others are more exact. Two mirror images"
            " can be equally good, so that no single point is the global maximum."
        ),
        alt="Gap to the ground truth and computing time of seven optimisers, ten runs each.",
        figure=lambda: optimisers_figure(peers, truth, BUDGET),
    )


def _stored(variant: str, count: int) -> Runs:
    table = EVOLUTION.load()
    table = table[table["variant"] == variant].head(count)

    def history(name: str) -> np.ndarray:
        columns = [column for column in table.columns if column.rpartition("_")[0] == name]
        return table[columns].to_numpy()

    return Runs(
        table[["x", "y", "z"]].to_numpy(),
        table["fitness"].to_numpy(),
        list(table["reason"]),
        {name: history(name) for name in genetic.Generation._fields},
    )


def _never_falls(best: np.ndarray) -> bool:
    return bool((np.diff(best, axis=1) >= 0).all())


def _counts(reasons: list[str]) -> dict[str, int]:
    return {reason: reasons.count(reason) for reason in ("generations", "stall")}


def _history_table(runs: Runs, names: tuple[str, ...]) -> pd.DataFrame:
    columns = {
        f"{name}_run_{k}": values for name in names for k, values in enumerate(runs.histories[name])
    }
    return pd.DataFrame(columns).rename_axis("generation").reset_index()
