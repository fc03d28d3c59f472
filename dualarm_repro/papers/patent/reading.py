"""The methods as `patent` has them: assumptions to scenario and settings of controller and network.

What the named assumptions do not say stays at its default, which is their nominal value.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...control.frozen import FrozenScenario
from ...control.neural.network_settings import NetworkSettings
from ...control.settings import ControllerSettings
from .document import CROSSING, frozen

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
    """The frozen crossing of the assumed robot, with what the named assumptions say about it."""
    return frozen(CROSSING[assumed["robot"]], **_fields(assumed, names))


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
