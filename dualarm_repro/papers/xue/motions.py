"""Master first, then slave with the master as moving obstacle, in one arrangement."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, NamedTuple, Self

import numpy as np

from ...errors import InputError
from ...planning.descent.compiled import plan_apf_compiled
from ...planning.field.control_points import control_points
from ...planning.field.obstacles import Obstacles, obstacles_of
from ...planning.master_slave import at_tool_speed
from ...planning.plan import Plan
from ...planning.settings import APFSettings
from ...scene import JointPath, PlacedArm, Scene
from ...tracking import memo
from .layout import Layout, placed_master, placed_slave
from .methods import Method, attraction_only, improved


@dataclass(frozen=True)
class Encounter:
    """How the arms meet; every field is the assumption of that name."""

    master_as_obstacle: str
    equal_speed_meaning: str

    @classmethod
    def of(cls, assumed: Mapping[str, Any]) -> Self:
        """What the assumptions say."""
        return cls(**{field.name: assumed[field.name] for field in fields(cls)})


class Case(NamedTuple):
    """Everything two motions depend on."""

    layout: Layout
    method: Method
    encounter: Encounter

    @classmethod
    def of(cls, assumed: Mapping[str, Any]) -> Self:
        """The case that the assumptions describe."""
        return cls(*(part.of(assumed) for part in (Layout, Method, Encounter)))


def attempt(
    placed: PlacedArm, start: np.ndarray, obstacles: Obstacles, settings: APFSettings
) -> Plan | None:
    """A plan to the goal of the arm, or None where its start touches an obstacle."""
    try:
        return plan_apf_compiled(placed, start, placed.goal, obstacles, settings)
    except InputError:
        return None


@memo(512)
def master_plan(layout: Layout, method: Method) -> Plan | None:
    """Fig. 8: the master past the window by the improved method."""
    placed = placed_master(layout)
    settings = improved(method, layout.window_centre, placed.goal)
    return attempt(placed, placed.start, window_obstacles(layout), settings)


@memo(64)
def master_undisturbed(layout: Layout, method: Method) -> Plan:
    """The master under attraction alone."""
    return _undisturbed(placed_master(layout), method)


@memo(512)
def slave_undisturbed(layout: Layout, method: Method) -> Plan | None:
    """Fig. 9: the slave under attraction alone; None out of reach."""
    placed = placed_slave(layout)
    return None if placed is None else _undisturbed(placed, method)


@memo(512)
def master_track(case: Case) -> JointPath | None:
    """Joint path of the master over the steps of the slave; None without a plan that arrives.

    ``same_step``: both make one joint step of equal bound per instant. ``same_tool_speed``: the
    end effector of the master moves as fast as that of the undisturbed slave on average.
    """
    plan = master_plan(case.layout, case.method)
    slave = slave_undisturbed(case.layout, case.method)
    if plan is None or slave is None or not plan.reached:
        return None
    if case.encounter.equal_speed_meaning == "same_step":
        return plan.joint_path()
    return JointPath(plan.path, at_tool_speed(slave.tcp_length / slave.steps)(plan))


@memo(512)
def slave_obstacles(case: Case) -> Obstacles | None:
    """Window and moving master as the slave's planner sees them."""
    track = master_track(case)
    if track is None:
        return None
    whole = case.encounter.master_as_obstacle == "joint_points"
    master = placed_master(case.layout)
    points = control_points(master.arm, case.method.control_points if whole else "end_effector")
    return window_obstacles(case.layout).with_arm(master, points, track)


@memo(512)
def slave_plan(case: Case) -> Plan | None:
    """Figs 10 and 11: the slave past window and moving master by the improved method."""
    obstacles = slave_obstacles(case)
    if obstacles is None:
        return None
    placed = placed_slave(case.layout)
    settings = improved(case.method, case.layout.window_centre, placed.goal)
    return attempt(placed, placed.start, obstacles, settings)


@memo(512)
def window_obstacles(layout: Layout) -> Obstacles:
    """The window alone."""
    return obstacles_of(Scene([placed_master(layout)], {"window": layout.window()}))


def _undisturbed(placed: PlacedArm, method: Method) -> Plan:
    nothing = obstacles_of(Scene([placed]))
    return plan_apf_compiled(placed, placed.start, placed.goal, nothing, attraction_only(method))
