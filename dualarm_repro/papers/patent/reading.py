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

#: Assumption to entry of a scenario.
_SCENARIO = {
    "base_distance": "base_distance",
    "duration": "duration",
    "time_law": "law",
    "capsules": "capsules",
}
#: Assumption to field of the controller settings.
_CONTROLLER = {
    "feedback_gain": "feedback",
    "avoidance_form": "form",
    "pair_selection": "selection",
    "damper_law": "damper",
    "damper_gain": "damper_gain",
    "outer_range": "outer",
    "inner_range": "inner",
    "limit_form": "angle_limits",
    "limit_gain": "limit_gain",
    "limit_margin": "limit_margin",
}
#: Assumption to field of the network settings.
_NETWORK = {
    "penalty_form": "penalty",
    "penalty_factor": "factor",
    "penalty_sharpness": "sharpness",
    "state_matrix": "hessian",
    "gain": "gamma",
    "gain_cap": "capped",
    "activation": "activation",
    "feed_forward": "feed_forward",
}
#: Assumption between two choices to the one that switches its field on.
_ON = {
    "limit_form": "velocity_and_angle",
    "state_matrix": "with_hessian",
    "gain_cap": "step_limited",
}
#: The assumptions on the avoidance rows.
AVOIDANCE = (
    "avoidance_form",
    "pair_selection",
    "damper_law",
    "damper_gain",
    "outer_range",
    "inner_range",
)
#: The assumptions on the form of the penalty.
PENALTY = ("penalty_form", "penalty_factor", "penalty_sharpness")
#: The assumptions on the bounds of the joints.
LIMITS = ("limit_form", "limit_gain", "limit_margin")


def crossing(assumed: Mapping[str, Any], *names: str) -> FrozenScenario:
    """The frozen crossing of the assumed robot, with what the named assumptions say about it."""
    return frozen(CROSSING[assumed["robot"]], **_fields(_SCENARIO, assumed, names))


def controller_settings(assumed: Mapping[str, Any], *names: str) -> ControllerSettings:
    """ControllerSettings of the controller from the named assumptions."""
    return ControllerSettings(**_fields(_CONTROLLER, assumed, names))


def network_settings(assumed: Mapping[str, Any], *names: str) -> NetworkSettings:
    """ControllerSettings of the network from the named assumptions."""
    return NetworkSettings(**_fields(_NETWORK, assumed, names))


def _fields(
    places: Mapping[str, str], assumed: Mapping[str, Any], names: tuple[str, ...]
) -> dict[str, Any]:
    values = {name: assumed[name] for name in names}
    return {
        places[name]: value == _ON[name] if name in _ON else value for name, value in values.items()
    }
