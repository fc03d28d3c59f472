"""A crossing for every robot, base distance and tip: the first draw that is wanted."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np

from ....arms import Arm
from ....control.frozen import arm_pair
from ....control.random_tasks import CircleTask, draw_task, stands_clear
from ....control.settings import ControllerSettings
from ....control.system import ArmSystem
from ....control.task_search import CROSSING, score
from ....control.tip import with_tip
from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen, alternatives
from ..document import RADII, SEED, redundant_arm

#: Fingertips of the hand of the Panda, ahead of its flange [m]; another arm gets a hand as long.
FINGERTIP = 0.1034
#: Draws at most.
_MOST = 3000
SETTINGS = Chosen(
    "patent",
    ("robot", "base_distance", "tip"),
    ranges=True,
    **{"draws": _MOST, "radii": list(RADII), "fingertip": FINGERTIP},
)


def tipped_arm(robot: str, tip: str, capsules: str = "widened") -> Arm:
    """The arm with the point that follows the path as its tip."""
    arm = redundant_arm(robot, capsules)
    return with_tip(arm, FINGERTIP) if tip == "fingertip" else arm


def cells() -> list[dict[str, Any]]:
    """One cell a combination."""
    names = ("robot", "base_distance", "tip")
    choices = [alternatives(f"patent.{name}", 0) for name in names]
    return [dict(zip(names, values, strict=True)) for values in product(*choices)]


def compute(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Number of the first draw that stands clear, collides deeply and can be avoided; -1: none."""
    system = arm_pair(tipped_arm(cell["robot"], cell["tip"]), cell["base_distance"])
    settings = ControllerSettings()
    for draw in range(_MOST):
        task = drawn(system, draw)
        if stands_clear(system, task) and score(system, task, CROSSING, settings) is not None:
            return {"draw": draw}
    return {"draw": -1}


def drawn(system: ArmSystem, draw: int) -> CircleTask:
    """Draw of this number, from the same stream as those of the frozen scenarios."""
    return draw_task(system, np.random.default_rng([SEED, draw]), RADII)


CROSSINGS = REGISTRY.keeps(
    Study(
        name="patent_crossings",
        title="Tasks in which both arms cross, searched for every robot, base distance and tip",
        cells=cells,
        compute=compute,
        seed=SEED,
        settings=SETTINGS,
    )
)
