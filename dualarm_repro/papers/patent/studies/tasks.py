"""Random tasks: which collide without avoidance, and how the QP and the network fare on them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....control.frozen import arm_pair
from ....control.joint_ranges import angle_excess, speed_excess
from ....control.neural.fixed_step import simulate_network
from ....control.neural.network_settings import NetworkSettings
from ....control.random_tasks import admissible, draw_task, naive_motion
from ....control.settings import ControllerSettings, RowForm
from ....control.simulate import simulate
from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ....ledger.comparison import Comparison
from ..document import COARSE_STEP, CONTROL_STEP, RADII, SEED, redundant_arm

#: What every draw is made with; the paths take as long as those of the frozen scenarios.
SETTINGS = Chosen(
    "patent",
    ("robot", "base_distance"),
    radii=list(RADII),
    step=COARSE_STEP,
    network_step=CONTROL_STEP,
    outer=ControllerSettings().outer,
    inner=ControllerSettings().inner,
)

_CHATTER = "motion with slack chatters between its rows, which amplifies round-off"
#: Columns of the study that another processor may give otherwise.
DELICATE = (
    Comparison("slack_distance", _CHATTER, absolute=2e-3),
    Comparison("slack_error", _CHATTER, relative=0.1),
    Comparison("slack_acceleration", _CHATTER, relative=0.5),
)


def cells() -> list[dict[str, int]]:
    """One cell a draw."""
    return [{"draw": k} for k in range(REGISTRY.assumption("patent.task_selection"))]


def compute(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Screen one task; if naive motion collides, run it with every reading, with slack and network.

    A task counts if its start is outside the outer range and the pseudo-inverse follows its path.
    """
    system = arm_pair(redundant_arm(SETTINGS["robot"]), SETTINGS["base_distance"])
    settings, task = ControllerSettings(), draw_task(system, rng, RADII)
    naive = naive_motion(system, task, settings)
    if not admissible(naive, settings):
        return {"counts": False}
    found: dict[str, Any] = {
        "counts": True,
        "naive_distance": naive.smallest_distance,
        "naive_beyond_angle": angle_excess(system, naive.q),
        "collides": naive.smallest_distance < 0,
    }
    if not found["collides"]:
        return found
    parts = (system, task.circles(system), task.q0)
    for form in RowForm:
        motion = simulate(*parts, ControllerSettings(form=form), dt=COARSE_STEP)
        found |= {
            f"{form}_completed": motion.completed,
            f"{form}_distance": motion.smallest_distance,
            f"{form}_error": motion.largest_error,
            f"{form}_acceleration": motion.peak_acceleration,
            f"{form}_energy": motion.energy,
        }
    limited = simulate(*parts, ControllerSettings(avoid=False), dt=COARSE_STEP)
    slack = simulate(*parts, settings, dt=COARSE_STEP, slack=True)
    network = simulate_network(*parts, settings, NetworkSettings(), dt=CONTROL_STEP)
    return found | {
        "limits_completed": limited.completed,
        "slack_completed": slack.completed,
        "slack_distance": slack.smallest_distance,
        "slack_error": slack.largest_error,
        "slack_acceleration": slack.peak_acceleration,
        "network_completed": network.completed,
        "network_distance": network.smallest_distance,
        "network_error": network.largest_error,
        "network_beyond_angle": angle_excess(system, network.q),
        "network_beyond_speed": speed_excess(system, network.x),
    }


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
