"""What many runs of one planner come to: how many miss, stand still, and are held there."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..descent.problem import PlanningProblem
from ..field.control_points import end_effector
from .held import held
from .runs import Runs
from .stuck import stationary


class Outcome(NamedTuple):
    """Runs of one planner.

    ``missed`` counts the runs that did not arrive, ``trapped`` those of them that were seen to
    stand still away from the goal, ``stationary`` those of these where the gradient is certified to
    vanish, and ``held`` those in a true minimum: a saddle does not hold an arm for good.
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


def outcome(made: PlanningProblem, runs: Runs, at_goal: float = 0.0) -> Outcome:
    """Counts and means of some runs of a problem; a mean over no run is NaN.

    Parameters
    ----------
    made
        In whose field, U_att + U_rep, a standstill is judged.
    at_goal
        Distance of the flange to its goal up to which a standstill is no trap [m]: a run that has
        to end at goal angles may rest at the goal position with others.
    """
    away = np.linalg.norm(end_effector(made.placed, runs.last) - made.goal_point, axis=1) > at_goal
    last, gradient = runs.last[runs.stuck & away], runs.gradient[runs.stuck & away]
    flat = stationary(made, last, gradient)
    return Outcome(
        runs=len(runs.reason),
        missed=int((~runs.reached).sum()),
        trapped=len(last),
        stationary=int(flat.sum()),
        held=int(held(made, last, flat).sum()),
        used=int(runs.used.sum()),
        rescued=int(runs.rescued.sum()),
        steps_reached=_mean(runs.steps[runs.reached]),
        steps_all=_mean(runs.steps),
        gradient=float(gradient.max(initial=0.0)),
    )


def _mean(values: np.ndarray) -> float:
    return float(values.mean()) if len(values) else float("nan")
