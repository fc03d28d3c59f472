"""Random tasks: how many collide without avoidance, and how many each reading completes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...control.settings import FORMS, Settings
from ...control.simulate import simulate
from ...ledger import REGISTRY, Study
from .robots import SEED
from .scenario import COARSE_STEP
from .tasks import arm_pair, draw_task, naive_motion

DRAWS = 6000
#: What every draw is made with; the paths take as long as those of the frozen scenarios.
SETTINGS: dict[str, Any] = {
    "robot": "panda",
    "base_distance": 0.6,
    "radii": [0.10, 0.20],
    "step": COARSE_STEP,
    "outer": Settings().outer,
    "inner": Settings().inner,
}


def cells() -> list[dict[str, int]]:
    """One cell a draw."""
    return [{"draw": k} for k in range(DRAWS)]


def compute(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Screen one task; if naive motion collides, run it with every reading and with slack.

    A task counts if its start is outside the outer range and the pseudo-inverse follows its path.
    """
    system, settings = arm_pair(SETTINGS["robot"], SETTINGS["base_distance"]), Settings()
    task = draw_task(system, rng, tuple(SETTINGS["radii"]))
    naive = naive_motion(system, task, settings)
    found: dict[str, Any] = {"counts": naive is not None}
    if naive is None:
        return found
    arrays = system.arrays
    beyond = max(float((naive.q - arrays.upper).max()), float((arrays.lower - naive.q).max()))
    found |= {
        "naive_distance": naive.smallest_distance,
        "naive_beyond_angle": beyond,
        "collides": naive.smallest_distance < 0,
    }
    if not found["collides"]:
        return found
    circles = task.circles(system)
    for form in FORMS:
        motion = simulate(system, circles, task.q0, Settings(form=form), dt=COARSE_STEP)
        found |= {
            f"{form}_completed": motion.completed,
            f"{form}_distance": motion.smallest_distance,
            f"{form}_error": motion.largest_error,
            f"{form}_acceleration": motion.peak_acceleration,
            f"{form}_energy": motion.energy,
        }
    motion = simulate(system, circles, task.q0, settings, dt=COARSE_STEP, slack=True)
    return found | {
        "slack_completed": motion.completed,
        "slack_distance": motion.smallest_distance,
        "slack_error": motion.largest_error,
    }


TASKS = REGISTRY.keeps(
    Study(
        name="patent_tasks",
        title="Random tasks of two Pandas: collisions without avoidance, completion with five "
        "readings",
        cells=cells,
        compute=compute,
        seed=SEED,
        settings=SETTINGS,
    )
)
