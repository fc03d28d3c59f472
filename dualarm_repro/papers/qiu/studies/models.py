"""Stored study of `qiu`: the slave around a standing master, as capsules and as convex hull.

The two models are the only difference: in each cell one task and one reading, everything that is
open about the search drawn from its plausible values.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....planning.checks.contact_check import contact_check
from ....planning.field.hull_obstacle import HullTrack, circles_on, hull_track
from ....planning.field.obstacles import Obstacles, obstacles_of
from ....planning.search.bidirectional_compiled import plan_bidirectional_compiled
from ....planning.search.failure import classify
from ....planning.search.variants import IMPROVED, TRADITIONAL
from ....planning.tasks.random_tasks import blocked_goal
from ....scene import JointPath, Scene, distances
from ....tracking import memo
from ..document import MARGIN, SEED, placed
from ..reading import Hull, Improved
from .drawing import OPEN, drawn

MODELS = ("capsules", "hull")
SEARCHES = {"traditional": TRADITIONAL, "improved": IMPROVED}
_COUNT = 900
#: What a search around nothing but a master leaves open.
_OPEN = tuple(name for name in OPEN if name != "floor")
_CIRCLES = ("hull_samples", "circle_plane")


def _cells() -> list[dict[str, Any]]:
    return [{"task": k} for k in range(_COUNT)]


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Both searches around both models of one standing master."""
    posture, start, goal = _task(rng)
    circles = Hull.nominal(**drawn(_CIRCLES, rng)).circles()
    reading, slave = Improved.nominal(**drawn(_OPEN, rng)), placed("slave")
    scene = _around(posture)
    standing = obstacles_of(scene)
    hull = hull_track(circles_on(placed("master"), circles, posture[np.newaxis]))
    models: dict[str, tuple[Obstacles, tuple[HullTrack, HullTrack] | None]] = {
        "capsules": (standing, None),
        "hull": (obstacles_of(scene, leave_out=("master",)), (hull, hull)),
    }
    row: dict[str, Any] = {"ratio": reading.gain_ratio}
    for model, (obstacles, hulls) in models.items():
        for name, variant in SEARCHES.items():
            settings = reading.settings(variant, goal)
            plan = plan_bidirectional_compiled(slave, start, goal, obstacles, settings, hulls)
            key = f"{model}_{name}"
            row[f"{key}_planner"] = plan.reached
            row[f"{key}_truth"] = plan.reached and reading.is_free(contact_check(scene, plan.path))
            if not variant.two_sided:
                row[f"{key}_failure"] = str(classify(plan))
    return row


def _task(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A posture of the master, a start and a goal of the slave (6,): clear, and the straight line
    between them in contact."""
    low, high = (np.clip(limit, -np.pi, np.pi) for limit in _both().limits)
    while True:
        ends = rng.uniform(low[:6], high[:6]), rng.uniform(low[6:], high[6:])
        if distances(_both(), np.concatenate(ends)).min() > MARGIN:
            scene = _around(ends[0])
            return ends[0], ends[1], blocked_goal(scene, ends[1], MARGIN, rng)


@memo()
def _both() -> Scene:
    return Scene([placed("master"), placed("slave")], {})


def _around(posture: np.ndarray) -> Scene:
    """The slave and a standing master."""
    return _both().replaying("master", JointPath(posture[np.newaxis]))


MODEL_TASKS = REGISTRY.keeps(
    Study(
        name="qiu_models",
        title="The slave around a standing master, as capsules and as convex hull",
        cells=_cells,
        compute=_cell,
        seed=SEED + 50,
        settings={"drawn": [*_CIRCLES, *_OPEN], "margin_m": MARGIN},
    )
)
