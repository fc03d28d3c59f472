"""The loop of :mod:`.apf`, compiled: the same path in a fraction of the time."""

from __future__ import annotations

from time import perf_counter
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...arguments import checked
from ...kernel import kernel
from ...scene.bodies import PlacedArm
from ...scene.vectors import dot, minus, vector
from ...settings import code
from ..field.field_kernels import evaluate, field_of, total_of, workspace
from ..field.obstacles import Obstacles
from ..plan import Plan, Record
from ..settings import APFSettings
from .outcome import finished
from .problem import PlanningProblem, problem
from .termination import StopReason, is_stuck, within
from .update_kernels import move
from .virtual_point import acting, initial, may_finish, switched

REACHED = code(StopReason.REACHED)
TRAPPED = code(StopReason.TRAPPED)
STEP_LIMIT = code(StopReason.STEP_LIMIT)


class Rules(NamedTuple):
    """Numbers of the loop, see the settings; tolerances are infinite where none is demanded."""

    update: int
    max_step: float
    gain: float
    sufficient_decrease: float
    max_halvings: int
    lower: np.ndarray
    upper: np.ndarray
    joint_tolerance: float
    position_tolerance: float
    step_limit: int
    stuck_rule: int
    stuck_steps: int
    stuck_threshold: float
    after_obstacles_rest: bool


class Rows(NamedTuple):
    """Where the loop writes the rows of a plan, ``step_limit + 1`` of each."""

    path: np.ndarray
    attractive: np.ndarray
    repulsive: np.ndarray
    virtual: np.ndarray
    clearance: np.ndarray
    active: np.ndarray
    potential: np.ndarray


class End(NamedTuple):
    """How a run ended: code of the reason, number of steps, and what the virtual point did."""

    reason: int
    steps: int
    activations: int
    arrivals: int


@checked
def plan_apf_compiled(
    placed: PlacedArm,
    start: ArrayLike,
    goal: ArrayLike,
    obstacles: Obstacles,
    settings: APFSettings,
) -> Plan:
    """As :func:`.apf.plan_apf`."""
    made = problem(placed, start, goal, obstacles, settings)
    return finished(made, descend_compiled(made))


def descend_compiled(made: PlanningProblem) -> Record:
    """As :func:`.apf.descend`."""
    began = perf_counter()
    rows = empty_rows(made)
    end = run(field_of(made), rules_of(made), made.switch_rules, made.start, rows)
    kept = Rows(*(part[: end.steps + 1].copy() for part in rows))[:-1]  # without the potential
    counts = end.activations, end.arrivals
    return Record(*kept, list(StopReason)[end.reason], *counts, perf_counter() - began)


def rules_of(made: PlanningProblem) -> Rules:
    """Numbers of a problem."""
    update, end = made.settings.update, made.settings.termination
    return Rules(
        code(update.rule),
        update.max_step,
        update.gain or 0.0,
        update.sufficient_decrease,
        update.max_halvings,
        *made.limits,
        *made.tolerances,
        end.step_limit,
        code(end.trap.rule),
        end.trap.steps,
        end.trap.threshold,
        end.trap.after_obstacles_rest,
    )


def empty_rows(made: PlanningProblem) -> Rows:
    """Arrays for one run; a later run may write over them."""
    count = made.settings.termination.step_limit + 1
    joints, points = len(made.start), len(made.points.joint)
    return Rows(
        np.empty((count, joints)),
        np.empty(count),
        np.empty((count, points)),
        np.empty(count),
        np.empty((count, points)),
        np.empty(count, dtype=np.bool_),
        np.empty(count),
    )


@kernel
def run(field, rules, switch_rules, start, rows):
    """Descend from ``start``; fills ``rows`` and returns an :class:`End`."""
    work = workspace(field)
    state = initial(switch_rules)
    rows.path[0] = start
    for step in range(rules.step_limit + 1):
        q = rows.path[step]
        terms = evaluate(field, q, step, work)
        rows.potential[step] = total_of(terms, acting(state, switch_rules))
        reason = -1
        if may_finish(state, switch_rules) and within(
            np.abs(q - field.goal).max(),
            distance(terms.flange, field.goal_point),
            rules.joint_tolerance,
            rules.position_tolerance,
        ):
            reason = REACHED
        elif step == rules.step_limit:
            reason = STEP_LIMIT
        else:
            waiting = rules.after_obstacles_rest and step < len(field.cores) - 1
            stuck = not waiting and is_stuck(
                rules.stuck_rule,
                rules.stuck_steps,
                rules.stuck_threshold,
                rows.path,
                rows.potential,
                state.since,
                step,
            )
            to_virtual = distance(terms.flange, field.virtual_point)
            state = switched(state, switch_rules, stuck, to_virtual, step)
            if state.trapped:
                reason = TRAPPED
        rows.attractive[step] = terms.attractive
        rows.repulsive[step] = work.repulsive
        rows.clearance[step] = work.clearance
        rows.virtual[step] = terms.virtual if state.active else 0.0
        rows.active[step] = state.active
        if reason >= 0:
            return End(reason, step, state.activations, state.arrivals)
        attracts = acting(state, switch_rules)
        here = total_of(terms, attracts)
        move(field, rules, q, step, attracts, here, work, rows.path[step + 1])
    return End(STEP_LIMIT, rules.step_limit, state.activations, state.arrivals)


@kernel
def distance(a, b):
    """|a - b| of a point and an array."""
    gap = minus(a, vector(b))
    return dot(gap, gap) ** 0.5
