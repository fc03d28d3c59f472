"""The planners by name, for the command line and for anyone who compares them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..arms import Arm
from ..errors import UnknownNameError
from .compiled import plan_apf_compiled
from .link_clearance import require_links_clear
from .master_slave import CoordinatedPlan, Planner, Task, plan_master_slave
from .settings import APFSettings, Attraction, Repulsion, Settings, Termination, Trap, Update
from .task_file import load_tasks


@dataclass(frozen=True)
class Method:
    """A planner and what its name stands for.

    Attributes
    ----------
    name, description : str
    settings : type
        What it is set up with; ``settings.model_json_schema()`` describes every field.
    adapted : callable
        Settings of the family -> those of this method, so that one file serves all of a family.
    default : callable
        Arm -> settings that suit its size, for a scene that brings none.
    planner : callable
    """

    name: str
    description: str
    settings: type[Settings]
    adapted: Callable[[APFSettings], APFSettings]
    default: Callable[[Arm], APFSettings]
    planner: Planner


def default_settings(arm: Arm) -> APFSettings:
    """Settings that scale with the reach of an arm: no number is taken from any publication."""
    reach = float(np.linalg.norm(arm.chain.translation[1:], axis=1).sum())
    influence, weight = 0.1 * reach, 0.25 * reach**2
    return APFSettings(
        attraction=Attraction(gain=1.0, joint_weight=weight),
        control_points=tuple(range(2, arm.nq + 2)),
        repulsion=Repulsion(gain=(0.1 * reach * influence) ** 2, influence=influence),
        update=Update(rule="gradient", gain=0.5 / (reach**2 + weight), max_step=0.02),
        termination=Termination(
            joint_tolerance=0.01,
            position_tolerance=0.005 * reach,
            step_limit=5000,
            trap=Trap(rule="block_means", steps=50, threshold=1e-3),
        ),
    )


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


def _apf(name: str, description: str, adapted: Callable[[APFSettings], APFSettings]) -> Method:
    return Method(name, description, APFSettings, adapted, default_settings, plan_apf_compiled)


METHODS: dict[str, Method] = {
    method.name: method
    for method in (
        _apf(
            "apf-improved",
            "attraction by position and joints, repulsion of all control points, virtual point",
            lambda settings: settings,
        ),
        _apf(
            "apf-traditional",
            "attraction and repulsion of the end effector, by position only",
            _at_the_tool,
        ),
        _apf(
            "apf-traditional-points",
            "attraction of the end effector by position, repulsion of all control points",
            _traditional,
        ),
        _apf("attraction-only", "attraction alone: obstacles are ignored", _attraction_only),
    )
}


def method(name: str) -> Method:
    """The method of a name.

    Raises
    ------
    UnknownNameError
        There is none.
    """
    if name not in METHODS:
        raise UnknownNameError("planning", "method", name, f"one of {', '.join(METHODS)}")
    return METHODS[name]


def settings_schema(name: str) -> dict[str, Any]:
    """JSON Schema of the settings of a method."""
    return method(name).settings.model_json_schema()


def plan_file(path: str | Path, name: str) -> CoordinatedPlan:
    """Plan the tasks of a task file or scene file by a method, arm after arm.

    Raises
    ------
    UnknownNameError
        No such method.
    DataFileError, InputError
        A wrong file; two bodies that touch at the start; a goal out of reach.
    """
    chosen, given = method(name), load_tasks(path)
    arms = {placed.name: placed for placed in given.scene.arms}
    tasks = {
        arm: Task(
            task.start,
            task.goal,
            chosen.adapted(given.settings or chosen.default(arms[arm].arm)),
        )
        for arm, task in given.tasks.items()
    }
    require_links_clear(given.scene, {arm: task.start for arm, task in given.tasks.items()})
    return plan_master_slave(
        given.scene,
        tasks,
        master_points=given.master_points,
        radius=given.radius,
        leave_out=given.leave_out,
        planner=chosen.planner,
    )
