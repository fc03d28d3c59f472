"""Stored study of `qiu`: master and slave on random pairs of goals in the printed scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....planning.tasks.random_tasks import blocked_goal
from ....planning.trials.yardstick import PACKAGE, YARDSTICK, yardstick
from ..document import MARGIN, PRINTED, SEED, dual_scene
from ..reading import Slave

PAIR_RATIOS = (1e-4, 1e-2, 1.0)
PAIR_POINTS = ("elbow_wrist_flange", "elbow_wrist", "four_with_link_radii")
_COUNT, _MOST_CHECKS = 96, 60_000


def _cells() -> list[dict[str, Any]]:
    return [{"pair": k} for k in range(_COUNT)]


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Master, then slave around its moving hull, in nine readings; RRT-Connect of both arms
    together."""
    scene, start = dual_scene(), np.tile(PRINTED.start, 2)
    goal = blocked_goal(scene, start, MARGIN, rng)
    row: dict[str, Any] = {}
    for points in PAIR_POINTS:
        for ratio in PAIR_RATIOS:
            reading = Slave.nominal(control_points=points, gain_ratio=ratio)
            planner, free, arms_clear = _planned(reading, goal)
            key = f"{points}_{ratio:g}"
            row[f"{key}_planner"], row[f"{key}_truth"] = planner, free
            row[f"{key}_arms_clearance"] = arms_clear
    return row | yardstick(scene, start, goal, rng, _MOST_CHECKS)


def _planned(reading: Slave, goal: np.ndarray) -> tuple[bool, bool, float]:
    """Planner's and true success of both arms, and the smallest distance between them [m]."""
    master = reading.plan_to(goal[:6])
    if not master.reached:
        return False, False, np.nan
    both = reading.around(master, goal[6:])
    if not both.reached:
        return False, False, np.nan
    check = both.contact(reading.scene())
    return True, check.free, check.clearance["arms"]


PAIRS = REGISTRY.keeps(
    Study(
        name="qiu_dual_pairs",
        peers={PACKAGE: f"{YARDSTICK}_"},
        title="Master and slave on random pairs of goals in the printed scene, and RRT-Connect",
        cells=_cells,
        compute=_cell,
        seed=SEED + 20,
        settings={"control_points": list(PAIR_POINTS), "margin_m": MARGIN},
    )
)
