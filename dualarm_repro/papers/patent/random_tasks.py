"""Random tasks: which collide without avoidance, and how the QP and the network fare on them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...control.motion import Motion
from ...control.neural.fixed_step import simulate_network
from ...control.neural.network_settings import NetworkSettings
from ...control.settings import ControllerSettings, RowForm
from ...control.simulate import simulate
from ...control.system import ArmSystem
from ...ledger import REGISTRY, Study
from ...ledger.comparison import Comparison
from .constants import COARSE_STEP, CONTROL_STEP, SEED
from .tasks import arm_pair, draw_task, naive_motion

DRAWS = 6000
#: What every draw is made with; the paths take as long as those of the frozen scenarios.
SETTINGS: dict[str, Any] = {
    "robot": "panda",
    "base_distance": 0.6,
    "radii": [0.10, 0.20],
    "step": COARSE_STEP,
    "network_step": CONTROL_STEP,
    "outer": ControllerSettings().outer,
    "inner": ControllerSettings().inner,
}

_CHATTER = "motion with slack chatters between its rows, which amplifies round-off"
#: Columns of the study that another processor may give otherwise.
DELICATE = (
    Comparison("slack_distance", _CHATTER, absolute=2e-3),
    Comparison("slack_error", _CHATTER, relative=0.1),
    Comparison("slack_acceleration", _CHATTER, relative=0.5),
)


def cells() -> list[dict[str, int]]:
    """One cell a draw."""
    return [{"draw": k} for k in range(DRAWS)]


def compute(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Screen one task; if naive motion collides, run it with every reading, with slack and network.

    A task counts if its start is outside the outer range and the pseudo-inverse follows its path.
    """
    system, settings = arm_pair(SETTINGS["robot"], SETTINGS["base_distance"]), ControllerSettings()
    task = draw_task(system, rng, tuple(SETTINGS["radii"]))
    naive = naive_motion(system, task, settings)
    found: dict[str, Any] = {"counts": naive is not None}
    if naive is None:
        return found
    found |= {
        "naive_distance": naive.smallest_distance,
        "naive_beyond_angle": _beyond_angle(system, naive),
        "collides": naive.smallest_distance < 0,
    }
    if not found["collides"]:
        return found
    circles = task.circles(system)
    for form in RowForm:
        motion = simulate(system, circles, task.q0, ControllerSettings(form=form), dt=COARSE_STEP)
        found |= {
            f"{form}_completed": motion.completed,
            f"{form}_distance": motion.smallest_distance,
            f"{form}_error": motion.largest_error,
            f"{form}_acceleration": motion.peak_acceleration,
            f"{form}_energy": motion.energy,
        }
    limited = simulate(system, circles, task.q0, ControllerSettings(avoid=False), dt=COARSE_STEP)
    slack = simulate(system, circles, task.q0, settings, dt=COARSE_STEP, slack=True)
    network = simulate_network(
        system, circles, task.q0, settings, NetworkSettings(), dt=CONTROL_STEP
    )
    return found | {
        "limits_completed": limited.completed,
        "slack_completed": slack.completed,
        "slack_distance": slack.smallest_distance,
        "slack_error": slack.largest_error,
        "slack_acceleration": slack.peak_acceleration,
        "network_completed": network.completed,
        "network_distance": network.smallest_distance,
        "network_error": network.largest_error,
        "network_beyond_angle": _beyond_angle(system, network),
        "network_beyond_speed": float((np.abs(network.x) - system.arrays.speed).max()),
    }


def _beyond_angle(system: ArmSystem, motion: Motion) -> float:
    """Largest excess over an angle limit, negative inside [rad]."""
    arrays = system.arrays
    return max(float((motion.q - arrays.upper).max()), float((arrays.lower - motion.q).max()))


TASKS = REGISTRY.keeps(
    Study(
        name="patent_tasks",
        title="Random tasks of two Pandas: collisions without avoidance, completion with five "
        "readings",
        cells=cells,
        compute=compute,
        compared=DELICATE,
        seed=SEED,
        settings=SETTINGS,
    )
)
