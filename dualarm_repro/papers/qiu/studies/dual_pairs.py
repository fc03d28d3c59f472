"""Stored study of `qiu`: master and slave on random pairs of goals in the printed scene.

Half of the pairs are uniform over the joints, half have both flanges in the box of the further
goals around the printed ones; the straight line to each of them is in contact.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.comparison import Comparison
from ....planning.field.control_points import end_effector
from ....planning.tasks.elbow_branches import branch_posture
from ....planning.tasks.random_tasks import blocked_goal
from ....planning.trials.yardstick import PACKAGE, YARDSTICK, yardstick
from ..document import MARGIN, PRINTED, SEED, dual_scene, placed
from ..reading import GoalBox, Slave

PAIR_RATIOS = (1e-4, 1e-2, 1.0)
PAIR_POINTS = ("elbow_wrist_flange", "elbow_wrist", "four_with_link_radii")
#: How the goals of a pair are drawn.
DRAWN = ("uniform", "near")
_COUNT, _MOST_CHECKS = 80, 60_000


def _cells() -> list[dict[str, Any]]:
    return [{"pair": k, "drawn": DRAWN[k % 2]} for k in range(2 * _COUNT)]


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Master, then slave around its moving hull, in nine readings; RRT-Connect of both arms
    together."""
    scene, start = dual_scene(), np.tile(PRINTED.start, 2)
    goal = blocked_goal(scene, start, MARGIN, rng, _near if cell["drawn"] == "near" else None)
    row: dict[str, Any] = {}
    for points in PAIR_POINTS:
        for ratio in PAIR_RATIOS:
            reading = Slave.nominal(control_points=points, gain_ratio=ratio)
            planner, free, arms_clear = _planned(reading, goal)
            key = f"{points}_{ratio:g}"
            row[f"{key}_planner"], row[f"{key}_truth"] = planner, free
            row[f"{key}_arms_clearance"] = arms_clear
    return row | yardstick(scene, start, goal, rng, _MOST_CHECKS)


def _near(rng: np.random.Generator) -> np.ndarray | None:
    """Joints of both arms (12,) [rad] with their flanges near the printed goals and their wrists as
    assumed; None where one is out of reach or of its limits."""
    box, slave = GoalBox.nominal(), Slave.nominal()
    points = (end_effector(box.arm(), box.posture()), PRINTED.slave_goal)
    near = [point + box.goal_set * rng.uniform(-1.0, 1.0, 3) for point in points]
    wrist, branch = slave.slave_wrist, slave.slave_branch
    found = box.posture_at(near[0]), branch_posture(placed("slave"), near[1], branch, wrist)
    if any(q is None or not box.arm().arm.within_limits(q) for q in found):
        return None
    return np.concatenate([q for q in found if q is not None])


def _planned(reading: Slave, goal: np.ndarray) -> tuple[bool, bool, float]:
    """Planner's and true success of both arms, and the smallest distance between them [m]."""
    master = reading.plan_to(goal[:6])
    if not master.reached:
        return False, False, np.nan
    both = reading.around(master, goal[6:])
    if not both.reached:
        return False, False, np.nan
    check = both.contact(reading.scene())
    return True, reading.is_free(check), check.clearance["arms"]


PAIRS = REGISTRY.keeps(
    Study(
        name="qiu_dual_pairs",
        peers={PACKAGE: f"{YARDSTICK}_"},
        title="Master and slave on random pairs of goals in the printed scene, and RRT-Connect",
        cells=_cells,
        compute=_cell,
        seed=SEED + 20,
        settings={"control_points": list(PAIR_POINTS), "margin_m": MARGIN},
        compared=(
            Comparison(
                "*_arms_clearance",
                "taken at samples of a path, between which more than this is missed",
                absolute=1e-5,
            ),
        ),
    )
)
