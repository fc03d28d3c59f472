"""Stored studies of `pan`: seeded genetic runs, other optimisers, one assumption at a time."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

import numpy as np

from ...ledger import REGISTRY, Study
from ...welding import evolve, grid_optimum
from ...welding.genetic import Generation
from ...welding.peers import OPTIMISERS as PEERS
from .nominal import Declared, alternatives, nominal_values
from .optimum import optimum
from .scenario import SEED, Genetic, Job, Measure

RUNS = 10
BUDGET = 4750  # evaluations
TRUTH = "ground truth"
TRUTH_SPACING = 0.05  # [m]
TRUTH_STARTS = 8
_JOB = tuple(field.name for field in fields(Job))
_MEASURE = tuple(field.name for field in fields(Measure))
_GENETIC = tuple(field.name for field in fields(Genetic))
#: Variants of the genetic algorithm: the declared one, another mutation, a coarse stall rule.
VARIANTS = {
    "declared": {},
    "adaptive mutation": {"mutation": "adaptive_feasible"},
    "coarse stall": {"stall": 1e-3},
}


def _optimiser_cells() -> list[dict[str, Any]]:
    runs = [{"optimiser": name, "run": run} for name in PEERS for run in range(RUNS)]
    return [{"optimiser": TRUTH, "run": 0}, *runs]


def _optimise(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """One run of one optimiser on the declared problem, with the same budget for each."""
    values = nominal_values()
    placement = Job.of(values).placement(Measure.of(values).reading())
    box, seed = np.array(values["search_box"]), int(rng.integers(1, 2**31))
    placement(np.zeros((1, 3)))  # compiles
    start = time.process_time()
    if settings["optimiser"] == TRUTH:
        found = grid_optimum(placement, box, TRUTH_SPACING, TRUTH_STARTS)
    else:
        found = PEERS[settings["optimiser"]](placement, box, BUDGET, seed)
    return {
        **dict(zip("xyz", map(float, found.position), strict=True)),
        "fitness": found.fitness,
        "evaluations": found.evaluations,
        "seconds": time.process_time() - start,
    }


def _evolution_cells() -> list[dict[str, Any]]:
    return [{"variant": name, "run": run} for name in VARIANTS for run in range(RUNS)]


def _evolve(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """One genetic run; its history is held at the last generation after it has ended."""
    values = nominal_values()
    placement = Job.of(values).placement(Measure.of(values).reading())
    declared = Genetic.of(values).settings()
    chosen = replace(declared, **VARIANTS[settings["variant"]])
    found = evolve(placement, np.array(values["search_box"]), chosen, rng)
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


def _sensitivity_cells() -> list[dict[str, Any]]:
    """The declared assumptions, then one of them changed at a time."""
    entries = {key: REGISTRY.declared(f"pan.{key}", "value") for key in (*_JOB, *_MEASURE)}
    changes = [
        {"assumption": key, "value": str(value)}
        for key in (*_JOB, *_MEASURE)
        if entries[key].varies
        for value in alternatives(key, 5)
        if value != entries[key].value
    ]
    return [{"assumption": "none", "value": ""}, *changes]


def _change_one(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    values = nominal_values()
    key = settings["assumption"]
    if key != "none":
        values[key] = next(v for v in alternatives(key, 5) if str(v) == settings["value"])
    box = tuple(tuple(side) for side in values["search_box"])
    found = optimum(Job.of(values), Measure.of(values), box)
    return {
        **dict(zip("xyz", map(float, found.position), strict=True)),
        "fitness": found.fitness,
    }


OPTIMISERS = Study(
    name="pan_optimisers",
    title="The genetic algorithm and other optimisers on the declared problem, ten seeds each",
    cells=_optimiser_cells,
    compute=_optimise,
    seed=SEED,
    settings=Declared((*_JOB, *_MEASURE, "search_box")),
    measured=("seconds",),
)
EVOLUTION = Study(
    name="pan_evolution",
    title="Histories of the genetic algorithm, ten seeds for each variant",
    cells=_evolution_cells,
    compute=_evolve,
    seed=SEED,
    settings=Declared((*_JOB, *_MEASURE, *_GENETIC, "search_box")),
)
SENSITIVITY = Study(
    name="pan_sensitivity",
    title="The optimum when one assumption at a time is changed",
    cells=_sensitivity_cells,
    compute=_change_one,
    seed=SEED,
    settings=Declared((*_JOB, *_MEASURE, "search_box")),
)
for _study in (OPTIMISERS, EVOLUTION, SENSITIVITY):
    REGISTRY.keeps(_study)
