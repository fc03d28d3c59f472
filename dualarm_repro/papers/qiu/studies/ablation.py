"""Stored study of `qiu`: every combination of the improvements over the ratio of the gains."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....planning.search.variants import VARIANTS
from ....planning.trials.campaign import campaign
from ..document import SEED
from ..reading import GoalBox, Improved

RATIOS = (1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 1.0)


def _cells() -> list[dict[str, Any]]:
    return [
        {"gain_ratio": ratio, "branch": branch, "control_points": points, "goal_seed": SEED + k}
        for ratio in RATIOS
        for branch in ("front_shallow", "front_deep")
        for points in ("elbow_wrist_flange", "four_with_link_radii")
        for k in range(4)
    ]


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Every combination of the three improvements on one set of goals; goals come from the cell."""
    reading = Improved.nominal(
        gain_ratio=cell["gain_ratio"],
        goal_branch=cell["branch"],
        control_points=cell["control_points"],
    )
    scene = reading.truth()
    goals = GoalBox.nominal(goal_branch=cell["branch"]).draw(cell["goal_seed"])
    row: dict[str, Any] = {"goals": len(goals.q), "rejected": sum(goals.rejected.values())}
    for variant in VARIANTS:
        made = campaign(partial(reading.plan_to, variant=variant), goals.q, scene)
        row[f"{variant.name}_planner"] = int(sum(made.planner))
        row[f"{variant.name}_truth"] = int(sum(made.truth))
        row[f"{variant.name}_searches"] = float(np.mean(made.searches)) if made.searches else np.nan
        row[f"{variant.name}_clearance"] = float(np.median(made.clearance))
        for name in ("displaced-goal", "midway-minimum"):
            row[f"{variant.name}_{name}"] = made.failures.get(name, 0)
    return row


ABLATION = REGISTRY.keeps(
    Study(
        name="qiu_ablation",
        title="Success of every combination of the three improvements over the ratio of the gains",
        cells=_cells,
        compute=_cell,
        seed=SEED,
    )
)
