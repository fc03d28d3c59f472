"""Many runs of one problem from different starts, without the rows of each: for statistics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...arguments import Joints, NonNegative, Number, checked
from ...kernel import kernel
from ...scene.bodies import PlacedArm
from ..field.field_kernels import evaluate, field_of, gradient, workspace
from ..field.obstacles import Obstacles
from ..settings import APFSettings
from .compiled import empty_rows, rules_of, run
from .follow_reason import REASONS, FollowReason
from .outcome import refined, rescued
from .problem import PlanningProblem, checked_starts, problem, require_clear
from .termination import StopReason


@dataclass(frozen=True, eq=False)
class Batch:
    """Ends of N runs.

    Attributes
    ----------
    reason : tuple of StopReason or FollowReason
    steps : ndarray (N,) of int
    last : ndarray (N, nq)
        Configurations at the end [rad].
    clearance : ndarray (N,)
        Smallest distance of any control point to the obstacles on the way [m].
    gradient_norm : ndarray (N,)
        |d(U_att + U_rep)/dq| at the end: near zero where a run is trapped in a minimum.
    activations, arrivals : ndarray (N,) of int
        Of the virtual point.
    rescued : ndarray (N,) of bool
        Whether the goal is reached after the virtual point was switched on in a trap.
    """

    reason: tuple[StopReason | FollowReason, ...]
    steps: np.ndarray
    last: np.ndarray
    clearance: np.ndarray
    gradient_norm: np.ndarray
    activations: np.ndarray
    arrivals: np.ndarray
    rescued: np.ndarray

    @property
    def reached(self) -> np.ndarray:
        """Which runs reached the goal (N,)."""
        return np.array([reason is StopReason.REACHED for reason in self.reason])


@checked
def plan_batch(
    placed: PlacedArm,
    starts: ArrayLike,
    goal: ArrayLike,
    obstacles: Obstacles,
    settings: APFSettings,
) -> Batch:
    """:func:`.compiled.plan_apf_compiled` from every row of ``starts`` (N, nq).

    Raises
    ------
    ConfigurationError, InputError
        As for a single plan; no start at all.
    """
    starts = checked_starts(placed, starts)
    made = problem(placed, starts[0], goal, obstacles, settings)
    require_clear(made, starts)
    last, numbers = np.empty_like(starts), np.empty((len(starts), 4), dtype=np.int64)
    measures = np.empty((len(starts), 2))
    given = field_of(made), rules_of(made), made.switch_rules, starts, empty_rows(made)
    _run_all(*given, last, numbers, measures)
    return batch_of(made, last, numbers, measures)


def batch_of(
    made: PlanningProblem, last: np.ndarray, numbers: np.ndarray, measures: np.ndarray
) -> Batch:
    """The batch of what a compiled loop left: last configurations (N, nq), reason, steps,
    activations and arrivals (N, 4), clearance and gradient norm (N, 2)."""
    codes, steps, activations, arrivals = numbers.T
    clearance, gradient_norm = measures.T
    ended = [REASONS[number] for number in codes]
    return Batch(
        tuple(refined(made, *end) for end in zip(ended, last, steps.tolist(), strict=True)),
        steps,
        last,
        clearance,
        gradient_norm,
        activations,
        arrivals,
        np.array([rescued(made, *end) for end in zip(ended, activations, strict=True)]),
    )


@kernel
def _run_all(field, rules, switch_rules, starts, rows, last, numbers, measures):
    """Fills ``last``, ``numbers`` (reason, steps, activations, arrivals) and ``measures``
    (clearance, gradient norm); ``rows`` is used again and again."""
    work = workspace(field)
    for n in range(len(starts)):
        end = run(field, rules, switch_rules, starts[n], rows)
        last[n] = rows.path[end.steps]
        numbers[n] = end
        measures[n, 0] = np.inf
        for step in range(end.steps + 1):
            for k in range(rows.clearance.shape[1]):
                measures[n, 0] = min(measures[n, 0], rows.clearance[step, k])
        evaluate(field, last[n], end.steps, work)
        gradient(field, last[n], end.steps, (True, False), work)
        measures[n, 1] = np.sqrt((work.gradient * work.gradient).sum())


@checked
def perturbed(
    start: Joints, half_width: NonNegative, count: Number, rng: np.random.Generator
) -> np.ndarray:
    """``count`` starts q + u with u uniform in [-half_width, half_width]^nq [rad], (count, nq)."""
    return start + rng.uniform(-half_width, half_width, (count, len(start)))
