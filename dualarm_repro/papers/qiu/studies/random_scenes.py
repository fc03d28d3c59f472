"""Stored study of `qiu`: every variant of the search and RRT-Connect in random scenes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....planning.checks.contact_check import contact_check
from ....planning.field.obstacles import obstacles_of
from ....planning.search.bidirectional_compiled import plan_bidirectional_compiled
from ....planning.search.failure import classify
from ....planning.search.variants import VARIANTS
from ....planning.trials.yardstick import PACKAGE, YARDSTICK, yardstick
from ..document import MARGIN, SEED, random_task
from ..reading import Improved

SCENE_RATIOS = (1e-4, 1e-2, 1.0)
_COUNT, _MOST_CHECKS = 300, 20_000


def _cells() -> list[dict[str, Any]]:
    return [{"scene": k, "spheres": 2 + k % 3} for k in range(_COUNT)]


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Every variant at three gain ratios, and RRT-Connect, on one random task; all of
    them know the same spheres and joint limits."""
    scene, start, goal = random_task(cell["spheres"], rng)
    arm, obstacles = scene.arms[0], obstacles_of(scene)
    row: dict[str, Any] = {}
    for ratio in SCENE_RATIOS:
        reading = Improved.nominal(gain_ratio=ratio)
        for variant in VARIANTS:
            chosen = reading.settings(variant)
            plan = plan_bidirectional_compiled(arm, start, goal, obstacles, chosen)
            key = f"{variant.name}_{ratio:g}"
            row[f"{key}_planner"] = plan.reached
            row[f"{key}_truth"] = bool(plan.reached and contact_check(scene, plan.path).free)
            row[f"{key}_searches"] = plan.searches
            if not variant.two_sided:
                row[f"{key}_failure"] = str(classify(plan))
    return row | yardstick(scene, start, goal, rng, _MOST_CHECKS)


SCENES = REGISTRY.keeps(
    Study(
        name="qiu_random_scenes",
        peers={PACKAGE: f"{YARDSTICK}_"},
        title="Every variant of the search and RRT-Connect in random scenes of two to four spheres",
        cells=_cells,
        compute=_cell,
        seed=SEED + 10,
        settings={"ratios": list(SCENE_RATIOS), "margin_m": MARGIN},
    )
)
