"""The genetic algorithm and other optimisers on the declared problem, ten seeds each."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ....welding import OPTIMISERS as PEERS
from ....welding import grid_optimum
from ..document import SEED
from ..reading import PROBLEM, Problem

RUNS = 10
BUDGET = 4750  # evaluations
TRUTH = "ground truth"
TRUTH_SPACING = 0.05  # [m]
TRUTH_STARTS = 8


def cells() -> list[dict[str, Any]]:
    """The ground truth, then every run of every optimiser."""
    runs = [{"optimiser": name, "run": run} for name in PEERS for run in range(RUNS)]
    return [{"optimiser": TRUTH, "run": 0}, *runs]


def compute(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """One run of one optimiser on the declared problem, with the same budget for each."""
    problem = Problem.of(REGISTRY.nominal("pan"))
    placement, seed = problem.placement(), int(rng.integers(1, 2**31))
    placement(np.zeros((1, 3)))  # compiles
    start = time.process_time()
    if settings["optimiser"] == TRUTH:
        found = grid_optimum(placement, problem.box, TRUTH_SPACING, TRUTH_STARTS)
    else:
        found = PEERS[settings["optimiser"]](placement, problem.box, BUDGET, seed)
    return {
        **dict(zip("xyz", map(float, found.position), strict=True)),
        "fitness": found.fitness,
        "evaluations": found.evaluations,
        "seconds": time.process_time() - start,
    }


def _certificate(settings: Mapping[str, Any], row: Mapping[str, Any]) -> dict[str, float]:
    """The fitness at the position of a row, without the search that found it."""
    position = np.array([[row[axis] for axis in "xyz"]])
    return {"fitness": float(Problem.of(REGISTRY.nominal("pan")).placement()(position)[0])}


OPTIMISERS = Study(
    name="pan_optimisers",
    title="The genetic algorithm and other optimisers on the declared problem, ten seeds each",
    cells=cells,
    compute=compute,
    seed=SEED,
    settings=Chosen("pan", (*PROBLEM, "search_box"), ranges=True),
    # Where a search of many steps ends, and on which side of the mirror, hangs on round-off.
    measured=("seconds", "evaluations", "fitness", *"xyz"),
    certificate=_certificate,
)
REGISTRY.keeps(OPTIMISERS)
