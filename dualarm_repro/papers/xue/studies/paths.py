"""What the motions of both methods are worth, over random arrangements in which Fig. 9 holds.

One run each from the unperturbed start: length and bending of the path of the end effector, how
thick the links may be, postures at which the field is looked at; whether the goal angles are
reached; and how far from its goal the end effector ever is, which (9) turns into attraction.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ....planning.checks.counted_field import counted_descent
from ....planning.checks.path_measures import bending
from ....planning.descent.compiled import plan_apf_compiled
from ....planning.plan import Plan
from .. import motions
from ..document import assumptions
from ..outcomes import DESCENTS, READINGS, VARIANTS, variant_of
from ..reading import KEPT, Case
from .lottery import DRAWN_WITH, random_case

ARRANGEMENTS = 100
METHODS = (*map(variant_of, READINGS), "improved")
#: Postures that a point followed by inverse kinematics looks at in a step, at least: that of the
#: field, and the nearest one, which is looked at for collisions.
FOLLOWED = 2
#: Between two samples of the path of the end effector whose bending is measured [m].
SPACING = 0.02


def paths_cell(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Every method in one random arrangement."""
    case = random_case(settings["meeting_distance"], rng)[0]
    master = motions.present(motions.master_plan(case.layout, case.planner), "plan of the master")
    found = {**asdict(case.layout), "master_rise": farther_later(master.tcp, master.tcp[-1])}
    for name in METHODS:
        found |= {f"{name}_{key}": value for key, value in path_row(case, name).items()}
    return found


def path_row(case: Case, name: str) -> dict[str, Any]:
    """One run of a method; of a path that does not arrive only its end counts."""
    variant = VARIANTS[name]
    made, plan = variant.problem(case), variant.plan(case)
    if plan is None:
        return {"arrives": False}
    row = {
        "arrives": plan.reached,
        "off_goal_angles": float(np.abs(plan.path[-1] - plan.goal).max()),
        "off_goal": float(np.linalg.norm(plan.tcp[-1] - made.goal_point)),
        "rise": farther_later(plan.tcp, made.goal_point),
    }
    if not plan.reached:
        return row
    descends = variant.single is plan_apf_compiled
    return row | {
        "steps": plan.steps,
        "tool_path": plan.tcp_length,
        "joint_path": plan.length,
        "bending": bending(plan.tcp, SPACING),
        "radius": link_radius(case, plan),
        "postures": counted_descent(made)[1] if descends else FOLLOWED * plan.steps,
    }


def farther_later(tcp: np.ndarray, goal: np.ndarray) -> float:
    """How much farther from a goal (3,) a path (N, 3) ever is than at its start, as a share."""
    away = np.linalg.norm(tcp - goal, axis=1)
    return float(away.max() / away[0] - 1.0)


def link_radius(case: Case, plan: Plan) -> float:
    """Radius of all links of the slave up to which none touches a bar or the master [m]."""
    replay = motions.present(motions.replay_of(case, plan), "motion of the master")
    smallest = motions.smallest_cores(motions.cores_of(replay, case.layout))
    return min(smallest["slave_window"], 0.5 * smallest["arms"])


def _cells() -> list[dict[str, Any]]:
    return [{"layout": k, **assumptions(*DRAWN_WITH)} for k in range(ARRANGEMENTS)]


PATHS = REGISTRY.keeps(
    Study(
        name="xue_paths",
        title="Random arrangements: length, bending, clearance and cost of every path",
        cells=_cells,
        compute=paths_cell,
        compared=DESCENTS,
        seed=20200349,
        settings=Chosen(
            "xue",
            (*KEPT, *DRAWN_WITH),
            ranges=True,
            arrangements=ARRANGEMENTS,
            spacing=SPACING,
            followed=FOLLOWED,
        ),
    )
)
