"""Stored study of `qiu`: what the variable gain and the adaptive step do on random tasks.

Chatter of the one-way search with constant and with variable gain, and searches from both ends with
every law of the step. In each cell, what is open about the gain and the step is drawn anew from its
plausible values, so that the cells sample the declared population.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....planning.checks.path_measures import MEASURES, chatter
from ....planning.field.obstacles import obstacles_of
from ....planning.search.bidirectional_compiled import plan_bidirectional_compiled
from ....planning.search.search_plan import SearchPlan
from ....planning.search.variants import Variant
from ..document import SEED, full_step, random_task
from ..reading import Improved
from .drawing import drawn

RATIOS = (1e-4, 1e-3, 1e-2, 1e-1, 1.0)
STEP_RULES = ("constant", "saturating", "plain_distance", "relative", "lengthened")
COUNT = 240
#: What a cell draws.
DRAWN = ("gain_rule", "kappa", "delta_rho", "flip_rule", "step_floor", "weights", "control_points")


def nearest(ratio: float, stored: tuple[float, ...] = RATIOS) -> float:
    """The stored ratio of gains nearest to another one, by their factor."""
    return min(stored, key=lambda known: abs(np.log(known / ratio)))


def _cells() -> list[dict[str, Any]]:
    return [{"task": k, "spheres": 2 + k % 3, "gain_ratio": RATIOS[k % 5]} for k in range(COUNT)]


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    scene, start, goal = random_task(cell["spheres"], rng)
    obstacles = obstacles_of(scene)
    values = drawn(DRAWN, rng)
    reading = Improved.nominal(**values, gain_ratio=cell["gain_ratio"])

    def run(reading: Improved, variant: Variant | None = None) -> SearchPlan:
        chosen = reading.settings(variant)
        return plan_bidirectional_compiled(scene.arms[0], start, goal, obstacles, chosen)

    row: dict[str, Any] = {"gain_rule": values["gain_rule"], "kappa": values["kappa"]}
    for name, variable in (("constant", False), ("variable", True)):
        height = run(reading, Variant(variable, False, False)).tcp[:, 2]
        row |= {f"{m}_{name}": chatter(height, m, full_step()) for m in MEASURES}
    for rule in STEP_RULES:
        plan = run(replace(reading, adaptive_step=rule))
        row |= {f"searches_{rule}": plan.searches, f"reached_{rule}": plan.reached}
    return row


IMPROVEMENTS = REGISTRY.keeps(
    Study(
        name="qiu_improvements",
        title="Chatter with constant and variable gain, searches with every law of the step",
        cells=_cells,
        compute=_cell,
        seed=SEED + 30,
        settings={"ratios": list(RATIOS), "drawn": list(DRAWN)},
    )
)
