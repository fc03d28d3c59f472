"""A search for a choice of the unprinted values whose optimum is the printed point."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ..document import SEED, printed_optimum
from ..reading import PROBLEM, Problem, optimum, solved

STARTS, DRAWS, EVALUATIONS = 4, 48, 320
_COARSE = 18  # seam points while searching
_NEAR = 0.025  # [m], where a climb may end
_SMALLEST = 0.01  # step, as a share of the range
_SAME = 1e-9  # [m], what round-off can change
#: The readings in which optima come nearest to print, see :mod:`.consistency`.
READINGS = {"base_transform": "literal", "objective": "tight"}
#: Assumptions that are changed.
VARIED = ("shoulder_height", "radius_main", "radius_branch", "workpiece_length",
          "gripper_length", "grasp", "flat_posture", "torch_length", "base_orientation",
          "floor")  # fmt: skip


def cells() -> list[dict[str, Any]]:
    """Independent climbs."""
    return [{"start": k} for k in range(STARTS)]


def compute(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """The best of some draws, then changes of one assumption at a time that bring it nearer.

    A coordinate search: a step up or down of a range, or another choice, is kept if the optimum
    moves towards the printed point; the step is halved when none helps. The end is computed anew
    with the declared number of seam points.
    """
    entries = {key: REGISTRY.declared(f"pan.{key}", "value", "range", "choices") for key in VARIED}
    draws = [dict(zip(VARIED, row, strict=True)) for row in rng.random((DRAWS, len(VARIED)))]
    gaps = [distance(_values(entries, draw), _COARSE) for draw in draws]
    shares, best, count, step = draws[int(np.argmin(gaps))], min(gaps), DRAWS, 0.25
    while count < EVALUATIONS and step >= _SMALLEST and best > _NEAR:
        improved = False
        for key in rng.permutation(VARIED):
            for trial in _neighbours(entries[key], shares[key], step):
                changed = shares | {key: trial}
                found, count = distance(_values(entries, changed), _COARSE), count + 1
                if found < best - _SAME:
                    shares, best, improved = changed, found, True
                    break
        step = step if improved else 0.5 * step
    values = _values(entries, shares)
    return {
        "distance": distance(values),
        "loss": loss(values),
        "evaluations": count,
        "values": json.dumps(values),
    }


def distance(values: Mapping[str, Any], seam_points: int | None = None) -> float:
    """From the optimum of changed assumptions to the printed point [m]; infinite without one."""
    best = optimum(_problem(values, seam_points))
    gap = float(np.linalg.norm(best.position - printed_optimum()))
    return gap if best.fitness else float("inf")


def loss(values: Mapping[str, Any]) -> float:
    """Share of the best measure that the printed point lacks; 1 where it is not feasible."""
    return loss_at_print(_problem(values))


def loss_at_print(problem: Problem) -> float:
    """1 - F(C) / F(best), with C as printed; 1 where it is not feasible."""
    printed, best = tuple(printed_optimum()), optimum(problem).fitness
    if not best or not solved(problem.job, printed).feasible[0]:
        return 1.0
    return float(1.0 - problem.placement()([printed])[0] / best)


def _problem(values: Mapping[str, Any], seam_points: int | None = None) -> Problem:
    every = {**REGISTRY.nominal("pan"), **values}
    return Problem.of(every | {"seam_points": seam_points} if seam_points else every)


def _values(entries: Mapping[str, Any], shares: Mapping[str, float]) -> dict[str, Any]:
    return READINGS | {key: entries[key].at(share) for key, share in shares.items()}


def _neighbours(entry: Any, share: float, step: float) -> list[float]:
    if entry.choices is not None:
        count = len(entry.choices)
        return [(k + 0.5) / count for k in range(count) if k != int(share * count)]
    moved = (share - step, share + step)
    return [float(np.clip(value, 0.0, 1.0 - 1e-12)) for value in moved]


FIT = Study(
    name="pan_fit",
    title="Search for a choice of the unprinted values whose optimum is the printed point",
    cells=cells,
    compute=compute,
    seed=SEED,
    settings=Chosen("pan", tuple(dict.fromkeys((*VARIED, *PROBLEM))), ranges=True),
    nested=("values",),
)
REGISTRY.keeps(FIT)
