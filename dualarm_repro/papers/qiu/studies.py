"""Stored studies of `qiu`: ablation over gain ratios, a post-hoc fit, random scenes, pairs of
goals.

All settings were fixed before the first run and are recorded with the outcome.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec
from typing import Any

import numpy as np

from ...ledger import REGISTRY, Study
from ...planning.checks.contact_check import contact_check
from ...planning.field.obstacles import Obstacles, obstacles_of
from ...planning.search.bidirectional_compiled import plan_bidirectional_compiled
from ...planning.search.failure import classify
from ...planning.search.rrt_connect import plan_rrt_connect
from ...planning.search.search_plan import SearchPlan
from ...planning.search.time_map import hull_tracks, replay, time_map
from ...scene import PlacedArm, Scene, distances
from ...tracking import memo
from .campaign import campaign
from .goals import draw_goals
from .printed_points import meeting
from .random_tasks import MARGIN, random_task
from .readings import (
    HULL,
    IMPROVED,
    IMPROVED_VARIANT,
    SPLICE,
    VARIANTS,
    Variant,
    circles,
    master_arm,
    master_posture,
    settings,
    smooth,
)
from .scenario import (
    SEED,
    START,
    arm_in_use,
    placed,
    repelling,
    truth_scene,
)

#: Choices of the studies that may differ from those of the ledger: the gains, and the law of the
#: step of the variants with ``A``.
CHOSEN: dict[str, Any] = {"gain_ratio": 1.0, "adaptive_step": "saturating"}
RATIOS = (1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 1.0)
SCENE_RATIOS = PAIR_RATIOS = (1e-4, 1e-2, 1.0)
PAIR_POINTS = ("elbow_wrist_flange", "elbow_wrist", "four_with_link_radii")
SCENE_COUNT, PAIR_COUNT = 300, 96


def frozen(*names: str) -> dict[str, Any]:
    """Settings of every search of the studies, and of ``names``, unless a cell says otherwise."""
    read = (*IMPROVED, "goal_set", *names)
    return {name: REGISTRY.assumption(f"qiu.{name}") for name in read} | CHOSEN


def _ablation_cells() -> list[dict[str, Any]]:
    return [
        {"gain_ratio": ratio, "branch": branch, "control_points": points, "goal_seed": SEED + k}
        for ratio in RATIOS
        for branch in ("front_shallow", "front_deep")
        for points in ("elbow_wrist_flange", "four_with_link_radii")
        for k in range(4)
    ]


def _ablation(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Every combination of the three improvements on one set of goals; goals come from the cell."""
    values = frozen() | {
        "gain_ratio": cell["gain_ratio"],
        "goal_branch": cell["branch"],
        "control_points": cell["control_points"],
    }
    goals = draw_goals(values, cell["goal_seed"])
    row: dict[str, Any] = {"goals": len(goals.q), "rejected": sum(goals.rejected.values())}
    for variant in VARIANTS:
        made = campaign(values, variant, goals)
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
        cells=_ablation_cells,
        compute=_ablation,
        seed=SEED,
        settings=CHOSEN,
    )
)


def _fit_cells() -> list[dict[str, Any]]:
    return [
        {"branch": branch, "control_points": points, "goal_radius": radius, "step": step}
        for branch in ("front_shallow", "front_deep")
        for points in ("elbow_wrist_flange", "elbow_wrist")
        for radius in (0.60, 0.61, 0.62, 0.63, 0.64, 0.65)
        for step in ("constant", "saturating")
    ]


FIT_RATIOS = tuple(float(f"{x:.2e}") for x in np.geomspace(1e-5, 1.0, 41))


def _fit(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """The ratio that brings the ends of the halves nearest to print, of all tried."""
    values = frozen() | {
        "goal_branch": cell["branch"],
        "control_points": cell["control_points"],
        "goal_radius": cell["goal_radius"],
    }
    variant = Variant(False, cell["step"] == "saturating", True)
    arm = master_arm(values)
    best: dict[str, Any] = {"tried": len(FIT_RATIOS), "error": np.inf}
    for ratio in FIT_RATIOS:
        chosen = settings(values | {"gain_ratio": ratio}, variant)
        plan = plan_bidirectional_compiled(arm, START, master_posture(values), repelling(), chosen)
        error = float(np.linalg.norm(np.array(plan.ends) - meeting(), axis=1).max())
        if plan.reached and error < best["error"]:
            check = contact_check(truth_scene([arm]), plan.path)
            best |= {
                "error": error,
                "gain_ratio": ratio,
                "searches": plan.searches,
                "clearance": check.clearance["obstacles"],
                "free": check.free,
            }
    return best


FIT = REGISTRY.keeps(
    Study(
        name="qiu_fit",
        title="Post-hoc fit of the meeting points of the master's halves",
        cells=_fit_cells,
        compute=_fit,
        seed=SEED,
        settings={**CHOSEN, "ratios": list(FIT_RATIOS)},
    )
)


def _scene_cells() -> list[dict[str, Any]]:
    return [{"scene": k, "spheres": 2 + k % 3} for k in range(SCENE_COUNT)]


def _scene(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Every variant at three gain ratios, and RRT-Connect, on one random task."""
    scene, start, goal = random_task(cell["spheres"], rng)
    arm, obstacles = scene.arms[0], _without_floor(scene)
    row: dict[str, Any] = {}
    for ratio in SCENE_RATIOS:
        for variant in VARIANTS:
            chosen = settings(frozen() | {"gain_ratio": ratio}, variant)
            plan = plan_bidirectional_compiled(arm, start, goal, obstacles, chosen)
            key = f"{variant.name}_{ratio:g}"
            row[f"{key}_planner"] = plan.reached
            row[f"{key}_truth"] = bool(plan.reached and contact_check(scene, plan.path).free)
            row[f"{key}_searches"] = plan.searches
            if not variant.two_sided:
                row[f"{key}_failure"] = str(classify(plan))
    return row | _yardstick(scene, start, goal, rng, 20_000)


def _yardstick(
    scene: Scene, start: np.ndarray, goal: np.ndarray, rng: np.random.Generator, most: int
) -> dict[str, Any]:
    """Outcome of RRT-Connect; nothing where OMPL is not installed, so that a spot check then
    compares everything else."""
    if find_spec("ompl") is None:
        return {}
    sampled = plan_rrt_connect(scene, start, goal, int(rng.integers(2**31 - 2)), most)
    return {
        "rrt_connect_planner": sampled.reached,
        "rrt_connect_truth": bool(sampled.reached and contact_check(scene, sampled.path).free),
        "rrt_connect_checks": sampled.checks,
    }


def _without_floor(scene: Scene) -> Obstacles:
    """The planner knows the spheres only, as in the document."""
    return obstacles_of(scene, leave_out=("floor",))


SCENES = REGISTRY.keeps(
    Study(
        name="qiu_random_scenes",
        peers={"ompl": "rrt_connect_"},
        title="Every variant of the search and RRT-Connect in random scenes of two to four spheres",
        cells=_scene_cells,
        compute=_scene,
        seed=SEED + 10,
        settings={**CHOSEN, "ratios": list(SCENE_RATIOS), "margin_m": MARGIN},
    )
)


def _pair_cells() -> list[dict[str, Any]]:
    return [{"pair": k} for k in range(PAIR_COUNT)]


@memo()
def _pair_scene() -> Scene:
    return truth_scene([placed("master"), placed("slave")])


def random_pair(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Goals (6,) of both arms in the printed scene: clear together, the straight lines in
    contact.
    """
    scene, arm = _pair_scene(), arm_in_use()
    low, high = np.maximum(arm.lower, -np.pi), np.minimum(arm.upper, np.pi)
    rest = np.zeros(12)
    while True:
        goal = rng.uniform(np.tile(low, 2), np.tile(high, 2))
        clear = distances(scene, goal).min() > MARGIN
        if clear and contact_check(scene, np.array([rest, goal])).smallest < 0.0:
            return goal[:6], goal[6:]


def _pair(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Master, then slave around its moving hull, in four readings; RRT-Connect of both arms
    together.
    """
    goals = random_pair(rng)
    scene = _pair_scene()
    arms = {arm.name: arm for arm in scene.arms}
    values = frozen(*SPLICE, *HULL, "schedule_steps")
    row: dict[str, Any] = {}
    for points in PAIR_POINTS:
        for ratio in PAIR_RATIOS:
            chosen = settings(
                values | {"control_points": points, "gain_ratio": ratio}, IMPROVED_VARIANT
            )
            planner, free, arms_clear = _planned_pair(arms, goals, chosen, scene, values)
            key = f"{points}_{ratio:g}"
            row[f"{key}_planner"], row[f"{key}_truth"] = planner, free
            row[f"{key}_arms_clearance"] = arms_clear
    return row | _yardstick(scene, np.zeros(12), np.concatenate(goals), rng, 60_000)


def _planned_pair(
    arms: Mapping[str, PlacedArm],
    goals: tuple[np.ndarray, np.ndarray],
    chosen: Any,
    scene: Scene,
    values: Mapping[str, Any],
) -> tuple[bool, bool, float]:
    """Planner's and true success of both arms, and the smallest distance between them [m]."""
    master = plan_bidirectional_compiled(arms["master"], START, goals[0], repelling(), chosen)
    if not master.reached:
        return False, False, np.nan
    path, spread = _smooth(values, master), round(values["schedule_steps"])
    hulls = hull_tracks(arms["master"], path, circles(values), spread)
    slave = plan_bidirectional_compiled(
        arms["slave"], START, goals[1], repelling(floor=True), chosen, hulls
    )
    if not slave.reached:
        return False, False, np.nan
    both = replay(path, _smooth(values, slave), time_map(slave, spread), spread)
    check = contact_check(scene, np.hstack(both))
    return True, check.free, check.clearance["arms"]


def _smooth(values: Mapping[str, Any], plan: SearchPlan) -> np.ndarray:
    return smooth(values, plan) if len(plan.path) >= 5 else plan.path


PAIRS = REGISTRY.keeps(
    Study(
        name="qiu_dual_pairs",
        title="Master and slave on random pairs of goals in the printed scene, and RRT-Connect",
        cells=_pair_cells,
        compute=_pair,
        seed=SEED + 20,
        settings={**CHOSEN, "control_points": list(PAIR_POINTS), "margin_m": MARGIN},
    )
)
