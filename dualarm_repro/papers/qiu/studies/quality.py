"""Stored study of `qiu`: paths to the goals around the printed one, and what they cost.

In each cell, what is open about the method is drawn anew from its plausible values, so that the
cells sample the declared population. Curvature is that of paths after the same spline, over their
length. An evaluation is one posture at which forces or contact are computed.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec
from time import perf_counter
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....planning.checks.contact_check import SAMPLING, contact_check
from ....planning.checks.path_measures import MEASURES, chatter
from ....planning.checks.regularity import crosses_singularity, least_singular_value
from ....planning.checks.smoothness import bending_of
from ....planning.search.rrt_connect import plan_rrt_connect
from ....planning.search.search_plan import SearchPlan
from ....planning.search.variants import IMPROVED, TRADITIONAL
from ....planning.trials.yardstick import PACKAGE, YARDSTICK
from ....scene import Scene, densify
from ..document import PRINTED, SEED, full_step
from ..reading import SHORTEST, GoalBox, Improved, Splice
from .drawing import OPEN, drawn

DRAWS = 60
SPACES = ("joints", "tip")
#: Columns begin with these.
METHODS = {"traditional": TRADITIONAL, "improved": IMPROVED}
_SPLICE, _BOX, _MOST_CHECKS = ("smoothing_weight", "end_weight"), ("goal_set",), 20_000


def _cells() -> list[dict[str, Any]]:
    goals = int(PRINTED.goals)
    return [{"goal": k % goals, "goal_seed": SEED + k // goals} for k in range(goals * DRAWS)]


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Both methods in one drawn reading, and RRT-Connect, to one of the goals of a seed."""
    values = drawn(OPEN, rng)
    reading, splice = Improved.nominal(**values), Splice.nominal(**drawn(_SPLICE, rng))
    box = {key: values[key] for key in ("goal_branch", "goal_wrist")} | drawn(_BOX, rng)
    row: dict[str, Any] = {"ratio": reading.gain_ratio, "bent": any(reading.goal_wrist)}
    goals = GoalBox.nominal(**box).draw(cell["goal_seed"]).q
    row["drawn"] = cell["goal"] < len(goals)
    if not row["drawn"]:
        return row
    goal, scene = goals[cell["goal"]], reading.truth()
    for name, variant in METHODS.items():
        plan = reading.plan_to(goal, variant)
        row |= {f"{name}_{key}": value for key, value in _judged(plan, reading, splice).items()}
    return row | _sampled(scene, goal, rng)


def _judged(plan: SearchPlan, reading: Improved, splice: Splice) -> dict[str, Any]:
    halves, step = plan.record.paths, full_step()
    row: dict[str, Any] = {
        "planner": plan.reached,
        "truth": plan.reached and reading.is_free(contact_check(reading.truth(), plan.path)),
        "evaluations": len(halves) * plan.searches,
        "check": len(densify(plan.path, SAMPLING)[0]),
        "time": plan.record.wall_time,
    }
    if plan.searches > SHORTEST:
        heights = [half[:, 2] for half in plan.half_tcp]
        row |= {m: max(chatter(z, m, step) for z in heights) for m in MEASURES}
    if plan.reached and len(plan.path) >= SHORTEST:
        path, spacing = splice.smooth(plan.path), {"joints": PRINTED.alpha0, "tip": step}
        row |= bending_of(plan, splice.smooth, spacing)
        row["singular_value"] = least_singular_value(plan.placed.arm, path)
        row["crosses"] = crosses_singularity(plan.placed.arm, path)
    return row


def _sampled(scene: Scene, goal: np.ndarray, rng: np.random.Generator) -> dict[str, Any]:
    """RRT-Connect on the same task; nothing where OMPL is not installed."""
    if find_spec(PACKAGE) is None:
        return {}
    began = perf_counter()
    found = plan_rrt_connect(scene, PRINTED.start, goal, int(rng.integers(2**31 - 2)), _MOST_CHECKS)
    taken = perf_counter() - began
    return {
        f"{YARDSTICK}_planner": found.reached,
        f"{YARDSTICK}_truth": found.path is not None and contact_check(scene, found.path).free,
        f"{YARDSTICK}_evaluations": found.checks,
        f"{YARDSTICK}_time": taken,
    }


QUALITY = REGISTRY.keeps(
    Study(
        name="qiu_quality",
        peers={PACKAGE: f"{YARDSTICK}_"},
        title="Paths to the goals around the printed one, how they bend and what they cost",
        cells=_cells,
        compute=_cell,
        seed=SEED + 40,
        settings={"drawn": [*OPEN, *_SPLICE, *_BOX]},
        measured=("traditional_time", "improved_time", f"{YARDSTICK}_time"),
    )
)
