"""Plans of planners that move all arms at once, in the form that reports and scenes read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from ..errors import DualArmError, InputError
from ..scene import JointPath, PlacedArm, densify
from .arm_path import ArmPath
from .descent.certificate import Certificate
from .foreign import asked, bordered
from .master_slave import CoordinatedPlan, Task
from .methods import Method
from .planner import FoundPath, PathPlanner, PathProblem, PlannerSettings
from .tasks.task_file import TaskSet

#: A joint this near to its goal has arrived [rad].
ARRIVED = 1e-2
#: A path begins at the start if no joint is further from it, which is rounding [rad].
_SAME = 1e-6


@dataclass(frozen=True, eq=False)
class PathPlan(ArmPath):
    """The part of one arm in a path of all.

    Attributes
    ----------
    path : ndarray (N, nq)
        [rad]
    goal : ndarray (nq,)
        [rad]
    reason : str
        Why the planner ended.
    reached : bool
        Whether the planner says so and this arm is at its goal.
    evaluations : int
        Configurations whose distances the planner asked for, for all arms together.
    """

    placed: PlacedArm
    path: np.ndarray
    goal: np.ndarray
    reason: str
    reached: bool
    evaluations: int

    @property
    def outside_limits(self) -> tuple[str, ...]:
        """Whether the ``path`` leaves the joint limits."""
        return () if bool(np.all(self.placed.arm.within_limits(self.path))) else ("path",)

    @property
    def certificate(self) -> Certificate | None:
        """None: there is no potential that could have a minimum."""
        return None

    def to_frame(self) -> pd.DataFrame:
        """One row per step: joints q1 ... [rad], flange x, y, z [m]."""
        return pd.DataFrame(self.columns()).rename_axis("step")


def as_plan(problem: PathProblem, found: FoundPath) -> CoordinatedPlan[Any]:
    """The path cut to the arms, with rows no further apart than the settings say."""
    scene = problem.scene
    path, _ = densify(found.path, problem.settings.resolution)
    plans: dict[str, PathPlan] = {}
    paths: dict[str, JointPath] = {}
    for placed in scene.arms:
        part = np.ascontiguousarray(path[:, scene.columns[placed.name]])
        goal = problem.goal[scene.columns[placed.name]]
        missed = np.abs(placed.arm.difference(goal, part[-1])).max()
        there = found.claimed and bool(missed <= ARRIVED)
        plans[placed.name] = PathPlan(placed, part, goal, found.reason, there, problem.evaluations)
        paths[placed.name] = JointPath(part)
    return CoordinatedPlan(scene, plans, paths)


def run_planner(
    name: str, planner: PathPlanner, problem: PathProblem, foreign: bool = True
) -> CoordinatedPlan[Any]:
    """What a planner answers, checked: nothing but errors of the library leaves it.

    Parameters
    ----------
    foreign : bool
        Whether it is the code of somebody else, which is given a copy of the problem.

    Raises
    ------
    InputError
        The planner fails, or its path is of the wrong form or does not begin at the start.
    """
    if foreign:
        found = asked(name, planner, problem)
    else:
        try:
            found = planner(problem)
        except DualArmError:
            raise
        except Exception as error:  # whatever a library below raises
            kind = " ".join(f"{type(error).__name__}: {error}".split())
            expected = f"a planner that answers ({kind})"
            raise InputError("planner", "method", name, expected) from error
    if not isinstance(found, FoundPath):
        raise InputError(f"planner {name}", "answer", type(found).__name__, "a FoundPath")
    with bordered(f"planner {name}", "answer", "path", "a FoundPath of rows of joints"):
        # Copies, which nothing changes after they have been checked.
        path, reason = problem.scene.configurations(found.path).copy(), f"{found.reason}"
    if path.ndim != 2 or not len(path) or np.abs(path[0] - problem.start).max() > _SAME:
        expected = f"rows of {problem.scene.nq} joints that begin at the start"
        raise InputError(f"planner {name}", "path", path.shape, expected)
    return as_plan(problem, FoundPath(path, " ".join(reason.split())))


def as_method(
    name: str, description: str, load: Callable[[], PathPlanner], foreign: bool = True
) -> Method[Any]:
    """A planner as an entry of the methods, which `plan_file` takes like any other.

    Parameters
    ----------
    load : callable
        Gives the planner when it is to plan.
    foreign : bool
        See :func:`run_planner`.
    """

    def plan(
        given: TaskSet[PlannerSettings], tasks: dict[str, Task[PlannerSettings]]
    ) -> CoordinatedPlan[Any]:
        if given.leave_out:
            expected = "nothing: by this method every body is known"
            raise InputError("task file", "leave_out", list(given.leave_out), expected)
        problem = PathProblem(
            given.scene,
            given.scene.stack(**{arm: task.start for arm, task in tasks.items()}),
            given.scene.stack(**{arm: task.goal for arm, task in tasks.items()}),
            next(iter(tasks.values())).settings,
        )
        return run_planner(name, load(), problem, foreign)

    return Method(
        name,
        description,
        lambda settings: settings,
        PlannerSettings,
        lambda arm: PlannerSettings(),
        plan,
        whole=True,
    )
