"""The methods as `patent` has them: assumptions to scenario and settings of controller and network.

What the named assumptions do not say stays at its default, which is their nominal value.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...control.frozen import FrozenScenario, arm_pair
from ...control.neural.network_settings import NetworkSettings
from ...control.settings import ControllerSettings
from ...errors import InputError
from .document import CROSSING, frozen, scenario_file
from .studies.crossings import CROSSINGS, drawn, tipped_arm

#: Assumption to field of the settings, or entry of a scenario, that has another name.
_PLACES = {
    "time_law": "law",
    "feedback_gain": "feedback",
    "avoidance_form": "form",
    "pair_selection": "selection",
    "damper_law": "damper",
    "outer_range": "outer",
    "inner_range": "inner",
    "limit_form": "angle_limits",
    "penalty_form": "penalty",
    "penalty_factor": "factor",
    "penalty_sharpness": "sharpness",
    "state_matrix": "hessian",
    "gain": "gamma",
    "gain_cap": "capped",
}
#: Assumption between two choices to the one that switches its field on.
_ON = {"limit_form": "velocity_and_angle", "state_matrix": "with_hessian",
       "gain_cap": "step_limited"}  # fmt: skip
#: The assumptions on the avoidance rows.
AVOIDANCE = ("avoidance_form", "pair_selection", "damper_law", "damper_gain", "outer_range",
             "inner_range")  # fmt: skip
#: The assumptions on the form of the penalty.
PENALTY = ("penalty_form", "penalty_factor", "penalty_sharpness")
#: The assumptions on the bounds of the joints.
LIMITS = ("limit_form", "limit_gain", "limit_margin")


def crossing(assumed: Mapping[str, Any], *names: str) -> FrozenScenario:
    """The crossing of the assumed robot, base distance and tip, with what the names say about it.

    Where it is not a frozen file, it is the one that was searched again for these three.

    Raises
    ------
    InputError
        The search found none.
    """
    robot, distance, tip = (assumed[name] for name in ("robot", "base_distance", "tip"))
    name, timing = CROSSING[robot], _fields(assumed, names)
    if tip == "flange" and distance == scenario_file(name).base_distance:
        return frozen(name, **timing)
    table = CROSSINGS.load()
    wanted = (
        (table["robot"] == robot) & (table["base_distance"] == distance) & (table["tip"] == tip)
    )
    number = int(table.loc[wanted, "draw"].iloc[0])
    if number < 0:
        raise InputError(
            "crossing", "base_distance", distance, "one at which a search found a task"
        )
    system = arm_pair(tipped_arm(robot, tip), distance)
    task, arms = drawn(system, number), arm_title(robot, tip)
    title = f"{arms}, bases {distance:g} m apart, whose arms cross without avoidance"
    return FrozenScenario(title, system, task.circles(system, **timing), task.q0)


def arm_title(robot: str, tip: str) -> str:
    """Which arms follow the paths, and with what."""
    name = {"panda": "Two Pandas", "xarm7": "Two xArm 7"}[robot]
    return name if tip == "flange" else f"{name} with their fingertips on the paths"


def controller_settings(assumed: Mapping[str, Any], *names: str) -> ControllerSettings:
    """Settings of the controller from the named assumptions."""
    return ControllerSettings(**_fields(assumed, names))


def network_settings(assumed: Mapping[str, Any], *names: str) -> NetworkSettings:
    """Settings of the network from the named assumptions."""
    return NetworkSettings(**_fields(assumed, names))


def _fields(assumed: Mapping[str, Any], names: tuple[str, ...]) -> dict[str, Any]:
    return {
        _PLACES.get(name, name): assumed[name] == _ON[name] if name in _ON else assumed[name]
        for name in names
    }
