"""For every reading, a search for a choice of the other values that makes print the optimum."""

from __future__ import annotations

import json
from collections.abc import Mapping
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ....welding import Optimum, grid_optimum
from ....welding.grid_search import pattern_search
from ....welding.landscape import nearer_image
from ..document import SEED, printed_optimum
from ..reading import PROBLEM, Problem, optimum, solved
from .consistency import OBJECTIVES, READINGS, VARIED

DRAWS, EVALUATIONS = 48, 256
_COARSE, _SPACING, _FOLLOWED = 18, 0.15, 2e-3  # seam points, [m], [m] while searching
_NEAR, _FLAT = 0.025, 1e-3  # [m] and share of the fitness, at which a climb may end
_SMALLEST = 0.01  # step, as a share of the range
_SAME = 1e-9  # [m], what round-off can change
#: Readings of (16) to the assumptions that say so; the welder alone is in none of them.
MEASURES = {
    name: {
        "weights": "inverse_volume" if reading.weights == "tight_only" else reading.weights,
        "objective": "tight" if reading.weights == "tight_only" else "mmr",
        "ellipsoid_space": reading.space,
        "carrier_weight": reading.carriers,
        "pair_measure": reading.pair,
        "aggregation": reading.aggregation,
        "length_unit": reading.unit,
    }
    for name, reading in OBJECTIVES.items()
    if reading.weights != "loose_only"
}


class _State(NamedTuple):
    """A choice as shares of the ranges, the optimum it leads to and its distance to print [m]."""

    shares: dict[str, float]
    found: Optimum
    distance: float


def cells() -> list[dict[str, Any]]:
    """One climb for every reading of the base matrix and of the measure."""
    return [{"base_transform": base, "measure": name} for base, name in product(READINGS, MEASURES)]


def compute(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """The best of some draws, then changes of one assumption at a time that bring it nearer.

    A coordinate search: a step up or down of a range, or another choice, is kept if the optimum
    moves towards the printed point; the step is halved when none helps. A change is first followed
    from the optimum known, and only one that looks better is looked at over the whole region. The
    end is computed anew with the declared seam points.
    """
    climb = _Climb({"base_transform": settings["base_transform"], **MEASURES[settings["measure"]]})
    draws = rng.random((DRAWS, len(VARIED)))
    state = min((climb.state(dict(zip(VARIED, row, strict=True))) for row in draws), key=_gap)
    step = 0.25
    while climb.evaluations < EVALUATIONS and step >= _SMALLEST and not climb.ended(state):
        improved = False
        for key in rng.permutation(VARIED):
            for trial in _neighbours(climb.entries[key], state.shares[key], step):
                better = climb.better(state, state.shares | {key: trial})
                if better:
                    state, improved = better, True
                    break
        step = step if improved else 0.5 * step
    problem = climb.problem(state.shares)
    return {
        "distance": distance(problem),
        "loss": loss_at_print(problem),
        "evaluations": climb.evaluations,
        "values": json.dumps(climb.values(state.shares)),
    }


class _Climb:
    """The problem as a function of the choices, and how many of them were evaluated."""

    def __init__(self, reading: Mapping[str, Any]) -> None:
        declared = REGISTRY.declared
        self.entries = {k: declared(f"pan.{k}", "value", "range", "choices") for k in VARIED}
        self.reading, self.evaluations = dict(reading), 0
        self.printed = printed_optimum()

    def values(self, shares: Mapping[str, float]) -> dict[str, Any]:
        """The choice as assumptions."""
        return self.reading | {key: self.entries[key].at(share) for key, share in shares.items()}

    def problem(self, shares: Mapping[str, float], seam_points: int | None = None) -> Problem:
        """The problem of a choice."""
        every = {**REGISTRY.nominal("pan"), **self.values(shares)}
        return Problem.of(every | {"seam_points": seam_points} if seam_points else every)

    def state(self, shares: dict[str, float]) -> _State:
        """Over the whole region."""
        self.evaluations += 1
        problem = self.problem(shares, _COARSE)
        placement = problem.placement()
        found = grid_optimum(placement, problem.box, _SPACING, 2, _FOLLOWED)
        return self._seen(shares, nearer_image(found, placement, self.printed))

    def better(self, state: _State, shares: dict[str, float]) -> _State | None:
        """A changed choice whose optimum is nearer to print, if it is."""
        if state.found.fitness:
            self.evaluations += 1
            problem = self.problem(shares, _COARSE)
            start = state.found.position
            near = pattern_search(problem.placement(), start, problem.box, 0.05, _FOLLOWED)
            if not self._seen(shares, near).distance < state.distance - _SAME:
                return None
        found = self.state(shares)
        return found if found.distance < state.distance - _SAME else None

    def ended(self, state: _State) -> bool:
        """Whether the printed point is the optimum of the coarse problem."""
        if state.distance > _NEAR:
            return False
        at_print = self.problem(state.shares, _COARSE).placement()([self.printed])[0]
        return bool(at_print >= (1 - _FLAT) * state.found.fitness)

    def _seen(self, shares: dict[str, float], found: Optimum) -> _State:
        gap = float(np.linalg.norm(found.position - self.printed))
        return _State(shares, found, gap if found.fitness else float("inf"))


def _gap(state: _State) -> float:
    return state.distance


def distance(problem: Problem) -> float:
    """From the optimum to the printed point [m]; infinite without one."""
    best = optimum(problem)
    gap = float(np.linalg.norm(best.position - printed_optimum()))
    return gap if best.fitness else float("inf")


def loss_at_print(problem: Problem) -> float:
    """1 - F(C) / F(best), with C as printed; 1 where it is not feasible."""
    printed, best = tuple(printed_optimum()), optimum(problem).fitness
    if not best or not solved(problem.job, printed).feasible[0]:
        return 1.0
    return float(1.0 - problem.placement()([printed])[0] / best)


def _neighbours(entry: Any, share: float, step: float) -> list[float]:
    if entry.choices is not None:
        count = len(entry.choices)
        return [(k + 0.5) / count for k in range(count) if k != int(share * count)]
    moved = (share - step, share + step)
    return [float(np.clip(value, 0.0, 1.0 - 1e-12)) for value in moved]


FIT = Study(
    name="pan_fit",
    title="For every reading, a search for a choice whose optimum is the printed point",
    cells=cells,
    compute=compute,
    seed=SEED,
    settings=Chosen("pan", tuple(dict.fromkeys((*VARIED, *PROBLEM, "search_box"))), ranges=True),
    nested=("values",),
)
REGISTRY.keeps(FIT)
