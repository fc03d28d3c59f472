"""Histories of the genetic algorithm on the declared problem, ten seeds for each variant."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ....welding import evolve
from ....welding.genetic import Generation
from ..document import SEED
from ..reading import PROBLEM, Genetic, Problem

RUNS = 10
#: Variants of the genetic algorithm: the declared one; noise that shrinks on a schedule; a coarse
#: stall rule; the stall rule of the named program, which watches the best fitness.
VARIANTS: dict[str, dict[str, Any]] = {
    "declared": {},
    "scheduled mutation": {"mutation": "gaussian"},
    "coarse stall": {"stall": 1e-3},
    "stall of the best": {"stall_of": "best", "stall_generations": 50},
}


def cells() -> list[dict[str, Any]]:
    """Every run of every variant."""
    return [{"variant": name, "run": run} for name in VARIANTS for run in range(RUNS)]


def compute(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """One genetic run; its history is held at the last generation after it has ended.

    Its fitness is 0 if no individual was feasible.
    """
    values = REGISTRY.nominal("pan")
    problem, declared = Problem.of(values), Genetic.of(values)
    chosen = replace(declared.settings(), **VARIANTS[settings["variant"]])
    found = evolve(problem.placement(), declared.box, chosen, rng, must_find=False)
    held = [*found.history, *[found.history[-1]] * (chosen.generations + 1 - len(found.history))]
    history = {
        f"{name}_{k}": float(getattr(generation, name))
        for k, generation in enumerate(held)
        for name in Generation._fields
    }
    return {
        **dict(zip("xyz", map(float, found.best), strict=True)),
        "fitness": found.fitness,
        "evaluations": found.evaluations,
        "generations": len(found.history) - 1,
        "reason": found.reason,
        **history,
    }


EVOLUTION = Study(
    name="pan_evolution",
    title="Histories of the genetic algorithm, ten seeds for each variant",
    cells=cells,
    compute=compute,
    seed=SEED,
    settings=Chosen("pan", (*PROBLEM, *Genetic.names()), ranges=True),
)
REGISTRY.keeps(EVOLUTION)


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


def stored_runs(count: int, variant: str = "declared") -> Runs:
    """The first ``count`` stored runs of a variant."""
    table = EVOLUTION.load()
    table = table[table["variant"] == variant].head(count)

    return Runs(
        table[["x", "y", "z"]].to_numpy(),
        table["fitness"].to_numpy(),
        list(zip(table["generations"].tolist(), table["reason"], strict=True)),
        {n: table.filter(regex=rf"^{n}_\d+$").to_numpy() for n in Generation._fields},
    )
