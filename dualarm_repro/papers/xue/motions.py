"""Master first, then slave with the master as moving obstacle; their distances on the way."""

from __future__ import annotations

from typing import TypeVar

import numpy as np

from ...errors import InputError
from ...planning.descent.compiled import plan_apf_compiled
from ...planning.field.control_points import control_points
from ...planning.field.obstacles import Obstacles, obstacles_of
from ...planning.master_slave import at_tool_speed
from ...planning.plan import Plan
from ...planning.settings import PointSet
from ...planning.trials.encounter import to_obstacles
from ...planning.trials.link_cores import LinkCores, link_cores
from ...planning.trials.replay import Replay
from ...planning.trials.runs import attempt
from ...scene import JointPath, PlacedArm, Scene
from ...tracking import memo
from .document import Layout, Posed, arms_of, placed_master, placed_slave, scene_of
from .reading import Case, PlannerChoice, attraction_only, improved

#: Largest joint step between two looks at whole links [rad].
_CLOSE = 0.02
#: Pairs of owners whose links are to stay clear of each other.
PAIRS = {
    "slave_window": ("slave", "window"),
    "master_window": ("master", "window"),
    "arms": ("master", "slave"),
}
_T = TypeVar("_T")


def present(found: _T | None, name: str) -> _T:
    """What an arrangement is known to hold.

    Raises
    ------
    InputError
        It does not.
    """
    if found is None:
        raise InputError("arrangement", name, None, "one that has it")
    return found


@memo(512)
def master_plan(layout: Layout, planner: PlannerChoice) -> Plan | None:
    """Fig. 8: the master past the window by the improved method."""
    placed = placed_master(layout)
    settings = improved(planner, layout.window_centre, placed.goal)
    return attempt(placed, placed.start, window_obstacles(layout), settings)


@memo(64)
def master_undisturbed(layout: Layout, planner: PlannerChoice) -> Plan:
    """The master under attraction alone."""
    return _undisturbed(placed_master(layout), planner)


@memo(512)
def slave_undisturbed(layout: Layout, planner: PlannerChoice) -> Plan | None:
    """Fig. 9: the slave under attraction alone; None out of reach."""
    placed = placed_slave(layout)
    return None if placed is None else _undisturbed(placed, planner)


def _undisturbed(placed: Posed, planner: PlannerChoice) -> Plan:
    settings = attraction_only(planner)
    return plan_apf_compiled(placed, placed.start, placed.goal, _nothing(), settings)


@memo()
def _nothing() -> Obstacles:
    return obstacles_of(Scene([PlacedArm("arm", arms_of("matrices")[0])]))


@memo(512)
def master_track(case: Case) -> JointPath | None:
    """Joint path of the master over the steps of the slave; None without a plan that arrives.

    ``same_step``: both make one joint step of equal bound per instant. ``same_tool_speed``: the
    end effector of the master moves as fast as that of the undisturbed slave on average.
    """
    plan = master_plan(case.layout, case.planner)
    slave = slave_undisturbed(case.layout, case.planner)
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
    points = control_points(master.arm, case.planner.control_points if whole else "end_effector")
    return window_obstacles(case.layout).with_arm(master, points, track)


def slave_task(case: Case) -> tuple[Posed, Obstacles]:
    """The slave between its ends, and what its planner is to avoid.

    Raises
    ------
    InputError
        An end is out of reach, or there is no motion of the master.
    """
    placed = present(placed_slave(case.layout), "slave")
    return placed, present(slave_obstacles(case), "motion of the master")


@memo(512)
def slave_plan(case: Case) -> Plan | None:
    """Figs 10 and 11: the slave past window and moving master by the improved method."""
    if slave_obstacles(case) is None:
        return None
    placed, obstacles = slave_task(case)
    settings = improved(case.planner, case.layout.window_centre, placed.goal)
    return attempt(placed, placed.start, obstacles, settings)


@memo(512)
def slave_without_master(case: Case) -> Plan | None:
    """The slave past the window by the improved method, with the master unknown to it."""
    placed, _ = slave_task(case)
    settings = improved(case.planner, case.layout.window_centre, placed.goal)
    return attempt(placed, placed.start, window_obstacles(case.layout), settings)


@memo(512)
def window_obstacles(layout: Layout) -> Obstacles:
    """The window alone."""
    return obstacles_of(Scene([placed_master(layout)], {"window": layout.window()}))


def points_to_window(plan: Plan, layout: Layout, points: PointSet = "end_effector") -> np.ndarray:
    """Signed distance of the nearest control point to the nearest bar, (N,) [m]."""
    return to_obstacles(plan, points, window_obstacles(layout)).min(axis=1)


@memo(512)
def replay_of(case: Case, slave: Plan | None) -> Replay | None:
    """The slave's plan beside the master's track, or None where one of them is missing."""
    track = master_track(case)
    if slave is None or track is None:
        return None
    return Replay(slave, placed_master(case.layout), track, window_obstacles(case.layout))


def cores_of(replay: Replay, layout: Layout, floor: float | None = None) -> LinkCores:
    """Core distances of all links until both arms rest."""
    return link_cores(scene_of(layout, floor), replay.paths, _CLOSE)


def smallest_cores(cores: LinkCores) -> dict[str, float]:
    """Smallest core distance over the motion: either arm to a bar, and between the arms [m]."""
    return {name: float(cores.between(*pair).min()) for name, pair in PAIRS.items()}


def largest_radius(smallest: dict[str, float]) -> float:
    """Radius of all links up to which none touches a bar or the other arm [m]."""
    return min(smallest["slave_window"], smallest["master_window"], 0.5 * smallest["arms"])
