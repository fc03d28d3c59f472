"""What the reproduction of `patent` feeds its methods with: frozen scenarios and settings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...control.circle import Circles
from ...control.motion import Motion
from ...control.neural.network_settings import NetworkSettings
from ...control.scenario import Scenario, load_scenario
from ...control.settings import ControllerSettings
from ...control.simulate import simulate
from ...control.system import ArmSystem
from ...datafiles import data_path
from ...tracking import memo
from .constants import CONTROL_STEP
from .tasks import Task, arm_pair

#: Frozen crossing of each robot.
CROSSING = {"panda": "crossing", "xarm7": "crossing_xarm7"}


@dataclass(frozen=True, eq=False)
class Frozen:
    """A scenario ready to run."""

    title: str
    system: ArmSystem
    circles: Circles
    q0: np.ndarray

    @property
    def period(self) -> float:
        """Duration of one turn [s]."""
        return self.circles.duration


@memo()
def frozen(name: str, **changes: Any) -> Frozen:
    """Scenario ``data/scenes/patent_<name>.yaml``, with some of its values changed.

    Parameters
    ----------
    changes
        ``base_distance`` and ``duration`` of the file, ``law`` of the circles, ``capsules`` of the
        arms.
    """
    file = scenario_file(name)
    system = arm_pair(
        file.robot,
        changes.get("base_distance", file.base_distance),
        capsules=changes.get("capsules", "widened"),
    )
    sides = (file.left, file.right)
    task = Task(
        np.concatenate([side.q for side in sides]),
        np.array([side.normal for side in sides]),
        np.array([side.angle for side in sides]),
        file.radius,
    )
    timing = {
        "duration": changes.get("duration", file.duration),
        "law": changes.get("law", "rest_to_rest"),
    }
    return Frozen(file.title, system, task.circles(system, **timing), task.q0)


@memo()
def scenario_file(name: str) -> Scenario:
    """The checked content of a scenario file."""
    return load_scenario(data_path("scenes", f"patent_{name}.yaml"))


def crossing(assumed: Mapping[str, Any], *names: str) -> Frozen:
    """The frozen crossing of the assumed robot, with what the named assumptions say about it."""
    return frozen(CROSSING[assumed["robot"]], **{_PLACES[name]: assumed[name] for name in names})


def settings_of(assumed: Mapping[str, Any], *names: str) -> ControllerSettings:
    """Controller settings from the named assumptions, the others at their defaults."""
    fields = {_FIELDS[name]: assumed[name] for name in names}
    if "angle_limits" in fields:
        fields["angle_limits"] = fields["angle_limits"] == "velocity_and_angle"
    return ControllerSettings(**fields)


def network_of(assumed: Mapping[str, Any], *names: str) -> NetworkSettings:
    """Settings of the network from the named assumptions, the others at their defaults."""
    fields = {_NETWORK_FIELDS[name]: assumed[name] for name in names}
    if "hessian" in fields:
        fields["hessian"] = fields["hessian"] == "with_hessian"
    if "capped" in fields:
        fields["capped"] = fields["capped"] == "step_limited"
    return NetworkSettings(**fields)


def run(
    scenario: Frozen, settings: ControllerSettings, dt: float = CONTROL_STEP, **options: Any
) -> Motion:
    """The exact controller on a frozen scenario."""
    return simulate(scenario.system, scenario.circles, scenario.q0, settings, dt=dt, **options)


#: Assumption to entry of a scenario.
_PLACES = {
    "base_distance": "base_distance",
    "duration": "duration",
    "time_law": "law",
    "capsules": "capsules",
}
#: Assumption to field of the settings.
_FIELDS = {
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
_NETWORK_FIELDS = {
    "penalty_form": "penalty",
    "penalty_factor": "factor",
    "penalty_sharpness": "sharpness",
    "state_matrix": "hessian",
    "gain": "gamma",
    "gain_cap": "capped",
    "activation": "activation",
    "feed_forward": "feed_forward",
}
