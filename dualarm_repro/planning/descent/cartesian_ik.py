"""A potential field in Cartesian space: the flange descends it as a point, by inverse kinematics.

X_(s+1) = X_s - t dU/dX, U = k/2 |X - X_g|^2 + U_rep(X) of the flange alone (O. Khatib, IJRR 5(1),
1986). At every step the closed form gives the postures of the next point, and each control point
of the nearest one is looked at for collisions. The tool turns from its orientation at the start to
that at the goal as its distance to the goal shrinks, R = R_g exp(l log(R_g^T R_0)) with
l = |X - X_g|/|X_0 - X_g|, at most 1.

A step of the point is at most ``max_step`` |X - X_b| long: so far the flange moves when all that
lies between it and the base X_b turns by ``max_step``.
"""

from __future__ import annotations

from dataclasses import replace
from time import perf_counter

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from ...arguments import checked
from ...arms.wrist_geometry import wrist_geometry
from ...kernel import kernel
from ...scene.bodies import PlacedArm
from ..field.control_points import control_points
from ..field.field_kernels import evaluate, field_of, gradient, workspace
from ..field.obstacles import Obstacles
from ..plan import Plan, Record
from ..settings import APFSettings
from .batch import Batch, batch_of
from .cartesian_kernels import Follower, follow
from .compiled import Rows, empty_rows, rules_of
from .follow_reason import REASONS
from .outcome import finished
from .problem import PlanningProblem, checked_starts, problem, require_clear


@checked
def plan_cartesian_ik(
    placed: PlacedArm,
    start: ArrayLike,
    goal: ArrayLike,
    obstacles: Obstacles,
    settings: APFSettings,
) -> Plan:
    """Follow -dU/dX with the flange until a named end; see the module.

    Of the settings the joint weight and the virtual point have no part in it; the control points
    are those looked at for collisions. Rows and certificate of the plan are those of the flange.

    Parameters
    ----------
    start, goal : (nq,)
        [rad]

    Raises
    ------
    ConfigurationError, InputError
        As for :func:`.apf.plan_apf`.
    UnsupportedArmError
        The arm has no closed form of its inverse kinematics.
    """
    made, checked = _problems(placed, start, goal, obstacles, settings)
    began, rows = perf_counter(), empty_rows(made)
    turn = _turns(made, made.start[np.newaxis])[0]
    end = follow(_follower(made, checked), field_of(made), rules_of(made), made.start, turn, rows)
    kept = Rows(*(part[: end.steps + 1].copy() for part in rows))[:-1]  # without the potential
    reason = REASONS[end.reason]
    return finished(made, Record(*kept, reason, 0, 0, perf_counter() - began))


@checked
def plan_cartesian_ik_batch(
    placed: PlacedArm,
    starts: ArrayLike,
    goal: ArrayLike,
    obstacles: Obstacles,
    settings: APFSettings,
) -> Batch:
    """:func:`plan_cartesian_ik` from every row of ``starts`` (N, nq), without the rows of each."""
    starts = checked_starts(placed, starts)
    made, checked = _problems(placed, starts[0], goal, obstacles, settings)
    require_clear(checked, starts)
    last, numbers = np.empty_like(starts), np.empty((len(starts), 4), dtype=np.int64)
    measures = np.empty((len(starts), 2))
    given = _follower(made, checked), field_of(made), rules_of(made), starts, _turns(made, starts)
    _follow_all(*given, empty_rows(made), last, numbers, measures)
    return batch_of(made, last, numbers, measures)


@kernel
def _follow_all(follower, field, rules, starts, turns, rows, last, numbers, measures):
    """As the loop of :mod:`.batch`, for points that the arm follows."""
    work = workspace(field)
    for n in range(len(starts)):
        end = follow(follower, field, rules, starts[n], turns[n], rows)
        last[n] = rows.path[end.steps]
        numbers[n] = end
        measures[n, 0] = rows.clearance[: end.steps + 1].min()
        evaluate(field, last[n], end.steps, work)
        gradient(field, last[n], end.steps, (True, False), work)
        measures[n, 1] = np.sqrt((work.gradient * work.gradient).sum())


def _problems(
    placed: PlacedArm,
    start: ArrayLike,
    goal: ArrayLike,
    obstacles: Obstacles,
    settings: APFSettings,
) -> tuple[PlanningProblem, PlanningProblem]:
    """The problem of the flange, whose field acts, and that of the points looked at."""
    plain = settings.changed(
        attraction=settings.attraction.changed(joint_weight=0.0), virtual_point=None
    )
    checked = problem(placed, start, goal, obstacles, plain)
    at_tool = plain.changed(control_points="end_effector", weights=None)
    return problem(placed, start, goal, obstacles, at_tool), checked


def _follower(made: PlanningProblem, checked: PlanningProblem) -> Follower:
    free = replace(made, points=control_points(made.placed.arm, "end_effector"))
    point = field_of(free)._replace(
        base=np.eye(3, 4), joint=np.zeros(1, dtype=np.int64), local=np.zeros((1, 2, 3))
    )
    goal = made.placed.placement.rotation @ made.placed.arm.fk(made.goal)[:3, :3]
    arm = made.placed.arm
    return Follower(point, field_of(checked), wrist_geometry(arm.name, arm.chain), goal)


def _turns(made: PlanningProblem, starts: np.ndarray) -> np.ndarray:
    """Rotation vectors of R_goal^T R_start (N, 3)."""
    arm = made.placed.arm
    goal = arm.fk(made.goal)[:3, :3]
    return np.array([pin.log3(goal.T @ T[:3, :3]) for T in arm.fk(starts)])
