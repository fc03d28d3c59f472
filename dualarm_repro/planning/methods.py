"""The planners by name, for the command line and for anyone who compares them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, Generic, TypeVar

from ..arguments import checked
from ..arms import Arm
from ..errors import DualArmError, InputError, UnknownNameError
from ..scene import JointPath, Scene
from ..settings import Settings
from .defaults import default_settings, default_two_arm_settings
from .descent.cartesian_ik import plan_cartesian_ik
from .descent.compiled import plan_apf_compiled
from .gate import require_sound
from .master_slave import CoordinatedPlan, Planner, Task, plan_master_slave
from .plan import Plan
from .planner_view import planner_scene, with_parked
from .search.bidirectional_arms import (
    SplicedPlan,
    TwoArmSettings,
    one_sided,
    plan_arms_bidirectional,
)
from .settings import APFSettings
from .tasks.task_file import TaskSet, load_tasks

AnyPlan = CoordinatedPlan[Plan | SplicedPlan]
_Settings = TypeVar("_Settings", bound=Settings)


@dataclass(frozen=True)
class Method(Generic[_Settings]):
    """A planner and what its name stands for.

    Attributes
    ----------
    name, description : str
    adapted : callable
        Settings of the family -> those of this method, so that one file serves all of a family.
    settings : type
        What it is set up with; ``settings.model_json_schema()`` describes every field.
    default : callable
        Arm -> settings that suit its size, for a scene that brings none.
    plan : callable
        Task set and tasks of the arms -> their plans.
    whole : bool
        Whether it takes every shape as it is; else the scene is simplified for it, see
        :func:`.planner_view.planner_scene`. Parked arms are obstacles either way.
    """

    name: str
    description: str
    adapted: Callable[[_Settings], _Settings]
    settings: type[_Settings]
    default: Callable[[Arm], _Settings]
    plan: Callable[[TaskSet[_Settings], dict[str, Task[_Settings]]], AnyPlan]
    whole: bool = False

    @checked
    def planned(self, path: str | Path, allow_collision: bool = False) -> AnyPlan:
        """See :func:`plan_file`."""
        given = load_tasks(path, self.settings, self.default)
        require_sound(given.path, given.scene, given.starts, given.goals, allow_collision)
        tasks = {
            arm: Task(task.start, task.goal, self.adapted(given.settings[arm]))
            for arm, task in given.tasks.items()
        }
        found = self._answered(replace(given, scene=self._told(given)), tasks)
        parked = {arm: JointPath([q]) for arm, q in given.parked.items()}
        residuals = {arm: task.residual for arm, task in given.tasks.items() if task.residual > 0.0}
        return replace(found, scene=given.scene, paths=found.paths | parked, residuals=residuals)

    def _told(self, given: TaskSet[_Settings]) -> Scene:
        if self.whole:
            return with_parked(given.scene, given.parked)
        starts = {arm: task.start for arm, task in given.tasks.items()}
        return planner_scene(given.scene, starts, given.parked)

    def _answered(self, told: TaskSet[_Settings], tasks: dict[str, Task[_Settings]]) -> AnyPlan:
        """The plan; what a library below raises becomes an error of this one."""
        try:
            return self.plan(told, tasks)
        except DualArmError:
            raise
        except (ArithmeticError, LookupError, RuntimeError, ValueError) as error:
            expected = f"a task that {self.name} can plan ({type(error).__name__}: {error})"
            raise InputError(told.path, "method", self.name, " ".join(expected.split())) from error


def _traditional(settings: APFSettings) -> APFSettings:
    return settings.changed(
        attraction=settings.attraction.changed(joint_weight=0.0),
        virtual_point=None,
        termination=settings.termination.changed(joint_tolerance=None),
    )


def _at_the_tool(settings: APFSettings) -> APFSettings:
    return _traditional(settings).changed(control_points="end_effector", weights=None)


def _attraction_only(settings: APFSettings) -> APFSettings:
    return settings.changed(repulsion=None, virtual_point=None)


def _in_turn(
    given: TaskSet[APFSettings],
    tasks: dict[str, Task[APFSettings]],
    planner: Planner = plan_apf_compiled,
) -> AnyPlan:
    return plan_master_slave(
        given.scene,
        tasks,
        master_points=given.master_points,
        radius=given.radius,
        leave_out=given.leave_out,
        planner=planner,
    )


def _from_both_ends(
    given: TaskSet[TwoArmSettings], tasks: dict[str, Task[TwoArmSettings]]
) -> AnyPlan:
    for field, value in (("master_points", given.master_points), ("radius", given.radius)):
        if value not in ("joint_points", None):
            expected = "nothing: by this method the hull of the master repels the slave"
            raise InputError("task file", field, value, expected)
    return plan_arms_bidirectional(given.scene, tasks, given.leave_out)


_APF = (APFSettings, default_settings, _in_turn)
_SEARCH = (TwoArmSettings, default_two_arm_settings, _from_both_ends)

AnyMethod = Method[APFSettings] | Method[TwoArmSettings]
METHODS: dict[str, AnyMethod] = {
    method.name: method
    for method in (
        Method(
            "apf-improved",
            "Attraction by position and joints, repulsion of all control points, virtual point",
            lambda settings: settings,
            *_APF,
        ),
        Method(
            "apf-traditional",
            "Attraction and repulsion of the end effector, by position only",
            _at_the_tool,
            *_APF,
        ),
        Method(
            "apf-traditional-points",
            "Attraction of the end effector by position, repulsion of all control points",
            _traditional,
            *_APF,
        ),
        Method(
            "apf-cartesian-ik",
            "The end effector as a point in the field; inverse kinematics and a look at every step",
            _traditional,
            APFSettings,
            default_settings,
            partial(_in_turn, planner=plan_cartesian_ik),
        ),
        Method(
            "attraction-only",
            "Attraction alone: obstacles are ignored",
            _attraction_only,
            *_APF,
        ),
        Method(
            "apf-bidirectional",
            "Search from both ends in joint space, variable gain and step; hull of the master",
            lambda settings: settings,
            *_SEARCH,
        ),
        Method(
            "apf-one-sided",
            "The same search from the start only, with constant gain and step",
            one_sided,
            *_SEARCH,
        ),
    )
}


@checked
def method(name: str) -> AnyMethod:
    """The method of a name.

    Raises
    ------
    UnknownNameError
        There is none.
    """
    if not isinstance(name, str) or name not in METHODS:
        raise UnknownNameError("planning", "method", name, f"one of {', '.join(METHODS)}")
    return METHODS[name]


@checked
def settings_schema(name: str) -> dict[str, Any]:
    """JSON Schema of the settings of a method."""
    return method(name).settings.model_json_schema()


@checked
def plan_file(path: str | Path, name: str, allow_collision: bool = False) -> AnyPlan:
    """Plan the tasks of a task file or scene file by a method, arm after arm.

    Every arm of the scene counts: one without a task is parked at its start. What the plan is
    worth says :func:`.checks.truth.truth` of its scene and paths.

    Parameters
    ----------
    allow_collision : bool
        Let bodies touch at the start and at the goal.

    Raises
    ------
    UnknownNameError
        No such method.
    DataFileError, InputError
        A wrong file; a goal out of reach.
    TaskFaults
        Bodies that touch, or joints beyond their limits, at the start or at the goal.
    """
    return method(name).planned(path, allow_collision)
