"""One row of the arena: a method on a case, judged by whole links between the steps too."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from enum import StrEnum
from time import process_time
from typing import Any

import numpy as np

from ..errors import DualArmError
from ..planning.checks.path_measures import bending
from ..planning.checks.truth import Truth, truth
from ..planning.field.control_points import end_effector
from ..planning.master_slave import Task
from ..planning.methods import AnyPlan, Method
from ..planning.path_plan import ARRIVED
from ..planning.planner import PlannerSettings
from ..planning.planner_view import planner_scene
from ..scene import JointPath
from .case import Case

#: Spacing of the samples by which the bending of a joint path is measured [rad].
SPACING = 0.05
#: Who ends this near to the goal is taken straight to it, and judged with this last piece [rad]. It
#: is more than the coarsest tolerance by which a contestant ends, 0.06 rad.
LAST_PIECE = 0.065
#: A flange this near to that of the goal is at the point that the task is about [m].
AT_THE_POINT = 0.01
#: Columns that depend on the machine.
MEASURED = ("time",)


class Outcome(StrEnum):
    """How a method ended on a case; every case has exactly one of each method."""

    SUCCESS = "certified success"
    COLLIDES = "arrives, collides"
    UNDECIDED = "arrives, not certified"
    LIMITS = "arrives beyond limits"
    OTHER_POSTURE = "other posture at the point"
    STOPPED = "stops on the way"
    REFUSED = "refuses the task"
    NO_TASK = "no task"


def judged_row(
    case: Case, method: Method[Any], evaluations: int, rng: np.random.Generator
) -> dict[str, Any]:
    """Run a method on a case and judge what it answers.

    Returns
    -------
    dict
        ``outcome``; ``claim``, whether the planner says that it arrived; ``reason`` in its words;
        ``lower`` and ``upper`` bound of the smallest distance of any two bodies [m];
        ``joint_length`` [rad] and ``tool_length`` [m], of all arms together; ``bending``, mean
        squared curvature of the joint path [1/rad^2]; ``evaluations`` of distances or of the
        field; ``time`` of the processor [s]. NaN for what there is not.
    """
    if case.fault:
        return {**_nothing(), "outcome": str(Outcome.NO_TASK), "reason": case.fault}
    begin = process_time()
    try:
        plan = answered(case, method, evaluations, int(rng.integers(2**31 - 2)))
    except (DualArmError, ArithmeticError, LookupError, RuntimeError, ValueError) as error:
        kind = str(error) if isinstance(error, DualArmError) else type(error).__name__
        return {**_nothing(), "outcome": str(Outcome.REFUSED), "reason": " ".join(kind.split())}
    time = process_time() - begin
    paths = completed(case, plan.paths)
    found = truth(case.scene, paths)
    claim = all(bool(one.reached) for one in plan.plans.values())
    return {
        "outcome": str(outcome_of(case, paths, found)),
        "claim": claim,
        "reason": ", ".join(f"{name}: {one.reason}" for name, one in plan.plans.items()),
        "lower": found.lower,
        "upper": found.upper,
        **measures(case, paths),
        "evaluations": evaluations_of(plan),
        "time": time,
    }


def answered(case: Case, method: Method[Any], evaluations: int, seed: int) -> AnyPlan:
    """The plan of a method for a case, with settings that suit the arms."""
    given = case.tasks(method)
    told = given.scene if method.whole else planner_scene(given.scene, given.starts, {})
    tasks = {}
    for name, task in given.tasks.items():
        settings = method.adapted(given.settings[name])
        if isinstance(settings, PlannerSettings):
            settings = settings.changed(seed=seed, evaluations=evaluations)
        tasks[name] = Task(task.start, task.goal, settings)
    return method.plan(replace(given, scene=told), tasks)


def completed(case: Case, paths: Mapping[str, JointPath]) -> dict[str, JointPath]:
    """The paths, those that end near their goals with a last straight piece to it."""
    made = {}
    for name, path in paths.items():
        goal, last = case.goals[name], path.configurations[-1]
        if 0.0 < np.abs(last - goal).max() <= LAST_PIECE:
            rows = np.vstack([path.configurations, goal])
            path = JointPath(rows, np.append(path.index, path.index[-1] + 1.0))
        made[name] = path
    return made


def outcome_of(case: Case, paths: Mapping[str, JointPath], found: Truth) -> Outcome:
    """What became of a case, whatever the planner says."""
    there = all(
        np.abs(path.at(path.index[-1:])[0] - case.goals[name]).max() <= ARRIVED
        for name, path in paths.items()
    )
    if not there:
        return Outcome.OTHER_POSTURE if _at_the_point(case, paths) else Outcome.STOPPED
    if found.upper <= 0.0:
        return Outcome.COLLIDES
    if not found.within_limits:
        return Outcome.LIMITS
    return Outcome.SUCCESS if found.collision_free else Outcome.UNDECIDED


def _at_the_point(case: Case, paths: Mapping[str, JointPath]) -> bool:
    ends = {name: path.configurations[-1] for name, path in paths.items()}
    away = [
        np.linalg.norm(end_effector(one, ends[one.name]) - end_effector(one, case.goals[one.name]))
        for one in case.scene.arms
    ]
    return bool(max(away) <= AT_THE_POINT)


def measures(case: Case, paths: Mapping[str, JointPath]) -> dict[str, float]:
    """Lengths and bending of the motion of all arms."""
    index = np.unique(np.concatenate([path.index for path in paths.values()]))
    rows = {name: path.at(index) for name, path in paths.items()}
    q = case.scene.stack(**rows)
    length = float(np.linalg.norm(np.diff(q, axis=0), axis=1).sum())
    tips = [np.diff(end_effector(one, rows[one.name]), axis=0) for one in case.scene.arms]
    return {
        "joint_length": length,
        "tool_length": float(sum(np.linalg.norm(step, axis=1).sum() for step in tips)),
        "bending": bending(q, SPACING) if length > 4 * SPACING else np.nan,
    }


def evaluations_of(plan: AnyPlan) -> int:
    """Configurations that a planner looked at: those it counts, else one for each of its steps."""
    plans = list(plan.plans.values())
    counted = [getattr(one, "evaluations", None) for one in plans]
    if counted and counted[0] is not None:
        return int(counted[0])
    return sum(one.steps + 1 for one in plans)


def _nothing() -> dict[str, Any]:
    numbers = ("lower", "upper", "joint_length", "tool_length", "bending", "time")
    return {"claim": False, **dict.fromkeys(numbers, np.nan), "evaluations": 0}
