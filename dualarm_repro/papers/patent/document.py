"""What the reproduction of `patent` runs its methods on: stand-in arms and frozen scenarios."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ...arms import Arm, load_arm
from ...control import task_search
from ...control.frozen import FrozenScenario
from ...control.link_capsules import with_capsules
from ...control.motion import Motion
from ...control.scenario import Scenario, load_scenario
from ...control.settings import ControllerSettings
from ...control.simulate import simulate
from ...datafiles import data_path
from ...tracking import memo

#: Entropy of everything random in this room.
SEED = 20240057
#: Rate of the controller, 1 kHz [s].
CONTROL_STEP = 1e-3
#: Step of runs that are repeated many times [s].
COARSE_STEP = 5e-3
#: Range of the radius of the circles that random tasks have [m].
RADII = (0.10, 0.20)
#: Frozen crossing of each robot.
CROSSING = {"panda": "crossing", "xarm7": "crossing_xarm7"}
#: Radii [m] with which the capsules of the Panda contain hand and base as well.
_WIDER = {"panda_hand_0": 0.057, "panda_link0_0": 0.101}


class Searched(NamedTuple):
    """How a frozen scenario was found: ``search_task`` for this robot among so many draws."""

    robot: str
    wanted: task_search.Wanted
    draws: int


SEARCHES = {
    "crossing": Searched("panda", task_search.CROSSING, 3000),
    "crossing_xarm7": Searched("xarm7", task_search.CROSSING, 3000),
    "limits": Searched("panda", task_search.TO_LIMITS, 1500),
    "too_close": Searched("panda", task_search.TOO_CLOSE, 3000),
}


@memo()
def redundant_arm(robot: str, capsules: str = "widened") -> Arm:
    """One arm of seven joints with its capsules; one capsule stands for both fingers of the Panda.

    A robot file says which shapes enclose a link, and not that one encloses two links or is wider.
    """
    arm = load_arm(robot)
    if robot != "panda":
        return arm
    fingers = [g for g in arm.geometry.geometryObjects if "finger" in g.name]
    middle = np.mean([g.placement.translation for g in fingers], axis=0)
    half = np.array([0.0, 0.0, fingers[0].geometry.halfLength])
    gap = np.linalg.norm(fingers[0].placement.translation - middle)
    radius = float(gap + fingers[0].geometry.radius)
    return with_capsules(
        arm,
        widened=_WIDER if capsules == "widened" else {},
        dropped=[g.name for g in fingers],
        added=[("fingers", fingers[0].parentJoint, middle - half, middle + half, radius)],
    )


@memo()
def scenario_file(name: str) -> Scenario:
    """The checked content of ``data/scenes/patent_<name>.yaml``."""
    return load_scenario(data_path("scenes", f"patent_{name}.yaml"))


@memo()
def frozen(name: str, *, capsules: str = "widened", **changes: Any) -> FrozenScenario:
    """A frozen scenario, with some of its values changed as in :meth:`.FrozenScenario.of`."""
    file = scenario_file(name)
    return FrozenScenario.of(file, redundant_arm(file.robot, capsules), **changes)


def run(
    scenario: FrozenScenario, settings: ControllerSettings, dt: float = CONTROL_STEP, **options: Any
) -> Motion:
    """The exact controller on a frozen scenario."""
    return simulate(*scenario.parts, settings, dt=dt, **options)
