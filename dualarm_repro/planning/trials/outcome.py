"""What many runs of one planner come to: how many miss, stand still, and are held there."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..descent.problem import PlanningProblem
from .runs import Runs
from .stuck import held, stationary


class Outcome(NamedTuple):
    """Runs of one planner.

    ``missed`` counts the runs that did not arrive, ``trapped`` those of them that were seen to
    stand still, ``stationary`` those of these where the gradient is certified to vanish, and
    ``held`` those that stay after small pushes too: a saddle does not hold an arm for good.
    ``used`` and ``rescued``: the virtual point acted, and acted with success. ``gradient`` is the
    largest |dU/dq| where a run stood still.
    """

    runs: int
    missed: int
    trapped: int
    stationary: int
    held: int
    used: int
    rescued: int
    steps_reached: float
    steps_all: float
    gradient: float


def outcome(made: PlanningProblem, runs: Runs, rng: np.random.Generator) -> Outcome:
    """Counts and means of some runs of a problem; a mean over no run is NaN.

    Parameters
    ----------
    rng
        Of the pushes.
    """
    last, gradient = runs.last[runs.stuck], runs.gradient[runs.stuck]
    return Outcome(
        runs=len(runs.reason),
        missed=int((~runs.reached).sum()),
        trapped=len(last),
        stationary=int(stationary(made, last, gradient).sum()),
        held=int(held(made, last, rng).sum()),
        used=int(runs.used.sum()),
        rescued=int(runs.rescued.sum()),
        steps_reached=_mean(runs.steps[runs.reached]),
        steps_all=_mean(runs.steps),
        gradient=float(gradient.max(initial=0.0)),
    )


def _mean(values: np.ndarray) -> float:
    return float(values.mean()) if len(values) else float("nan")
