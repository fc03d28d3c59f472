"""Descent of an artificial potential field, readable; :mod:`.compiled` runs the same loop."""

from __future__ import annotations

from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike

from ...arguments import checked
from ...scene.bodies import PlacedArm
from ...settings import code
from ..field.control_points import end_effector
from ..field.obstacles import Obstacles
from ..plan import Plan, Record
from ..settings import APFSettings
from .outcome import finished
from .problem import PlanningProblem, problem
from .termination import StopReason, is_stuck, within
from .updates import next_configuration
from .virtual_point import initial, may_finish, switched


@checked
def plan_apf(
    placed: PlacedArm,
    start: ArrayLike,
    goal: ArrayLike,
    obstacles: Obstacles,
    settings: APFSettings,
) -> Plan:
    """Follow -dU/dq, U = U_att + U_rep (+ U_v while a virtual point acts), until a named end.

    Each step: has the arm arrived; does it stand still; is the virtual point to be switched; move.
    The settings bound the number of steps. Moving obstacles are met at the index of the step.

    Parameters
    ----------
    start, goal : (nq,)
        [rad]

    Raises
    ------
    ConfigurationError, InputError
        See :func:`.problem.problem`.
    """
    made = problem(placed, start, goal, obstacles, settings)
    return finished(made, descend(made))


def descend(made: PlanningProblem) -> Record:
    """The loop of :func:`plan_apf`."""
    began = perf_counter()
    end, trap, rules = made.settings.termination, made.settings.termination.trap, made.switch_rules
    path = np.empty((end.step_limit + 1, len(made.start)))
    potential = np.empty(end.step_limit + 1)
    path[0], state, step = made.start, initial(rules), 0
    rows: list[tuple[ArrayLike, ...]] = []
    while True:
        q = path[step]
        reason: StopReason | None = None
        potential[step] = made.field_in(state).value(q, step)
        if may_finish(state, rules) and within(*made.errors(q), *made.tolerances):
            reason = StopReason.REACHED
        elif step == end.step_limit:
            reason = StopReason.STEP_LIMIT
        else:
            judged = (code(trap.rule), trap.steps, trap.threshold)
            waiting = trap.after_obstacles_rest and made.obstacles.moving(step)
            stuck = not waiting and is_stuck(*judged, path, potential, state.since, step)
            state = switched(state, rules, stuck, _to_virtual_point(made, q), step)
            if state.trapped:
                reason = StopReason.TRAPPED
        rows.append(_terms(made, q, step, state.active))
        if reason is not None:
            break
        at = q, step, made.settings.update, made.limits
        path[step + 1] = next_configuration(made.field_in(state), *at)
        step += 1
    attractive, repulsive, virtual, clearance, active = map(np.array, zip(*rows, strict=True))
    looks = path[: step + 1].copy(), attractive, repulsive, virtual, clearance, active
    counts = state.activations, state.arrivals
    return Record(*looks, reason, *counts, perf_counter() - began)


def _terms(made: PlanningProblem, q: np.ndarray, step: int, active: bool) -> tuple[ArrayLike, ...]:
    """Attractive, repulsive (K,) and virtual potential, clearance (K,), whether the point acts."""
    return (
        made.attraction.value(q),
        made.repulsion.terms(q, step),
        made.virtual.value(q) if active else 0.0,
        made.repulsion.distances(q, step).min(axis=1, initial=np.inf),
        active,
    )


def _to_virtual_point(made: PlanningProblem, q: np.ndarray) -> float:
    point = made.settings.virtual_point
    if point is None:
        return np.inf
    return float(np.linalg.norm(end_effector(made.placed, q) - np.array(point.position)))
