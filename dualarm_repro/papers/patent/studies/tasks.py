"""Random tasks: which collide without avoidance, and how the QP and the network fare on them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....control.frozen import arm_pair
from ....control.joint_ranges import angle_excess, speed_excess
from ....control.motion import Motion
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

#: Columns and the properties of a motion that they hold.
MEASURES = (
    ("completed", "completed"),
    ("distance", "smallest_distance"),
    ("error", "largest_error"),
    ("acceleration", "peak_acceleration"),
    ("energy", "energy"),
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
        found |= _judged(form, simulate(*parts, ControllerSettings(form=form), dt=COARSE_STEP), 5)
    limited = simulate(*parts, ControllerSettings(avoid=False), dt=COARSE_STEP)
    slack = simulate(*parts, settings, dt=COARSE_STEP, slack=True)
    network = simulate_network(*parts, settings, NetworkSettings(), dt=CONTROL_STEP)
    return {
        **found,
        **_judged("limits", limited, 1),
        **_judged("slack", slack, 4),
        **_judged("network", network, 3),
        "network_beyond_angle": angle_excess(system, network.q),
        "network_beyond_speed": speed_excess(system, network.x),
    }


def _judged(name: str, motion: Motion, count: int) -> dict[str, Any]:
    """The first so many measures of a motion, as columns."""
    return {f"{name}_{key}": getattr(motion, measure) for key, measure in MEASURES[:count]}


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
