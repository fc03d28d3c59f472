"""Table 2 of `qiu`, the claims on success, smoothness and local minima."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Bounded, Generally, NoOriginal, Result, Rounds
from ...planning.search.failure import Failure
from ...planning.search.search_plan import SearchPlan
from ...planning.search.splice import smoothed
from ...view.success_curves import rate_figure
from .campaign import JUDGED_BY, rate_of
from .goals import draw_goals
from .improvements import nearest
from .readings import IMPROVED_VARIANT, TRADITIONAL_VARIANT, master_arm, plan_to
from .scenario import ALPHA0, ETA0, SEED, START, ZETA, placed, reach
from .smoothness import bending, until_rest
from .studies import ABLATION, SCENE_RATIOS, SCENES
from .witnesses import witnesses

checks = partial(REGISTRY.checks, page="qiu/success")
METHODS = {"traditional": "traditional", "improved": "VAB"}
_PAIR = (TRADITIONAL_VARIANT, IMPROVED_VARIANT)
_BRANCH, _POINTS = "front_shallow", "elbow_wrist_flange"
_SPACES = ("joints", "tip")
_COLUMNS = [f"{method}_{space}" for method in METHODS for space in _SPACES]
_SHORTEST = 5


def better_cells(success_rule: str) -> tuple[pd.DataFrame, pd.Series]:
    """Cells of the ablation, and in which of them the improved method has the higher rate."""
    table, judged = ABLATION.load(), JUDGED_BY[success_rule]
    return table, table[f"VAB_{judged}"] > table[f"traditional_{judged}"]


_HIGHER = Generally(
    "better",
    "choices of gains, posture and control points with a higher rate of the improved method",
    at_least="most",
    margin="split",
)
_SHOWN = ("gain_ratio", "branch", "control_points", "goal_seed")


@checks(
    "qiu.tab02",
    rules=[
        Rounds("goals", "goals that both methods are tried on", to="goals"),
        _HIGHER,
        NoOriginal("rates", "the body of the table"),
    ],
)
def table_2(assumed: Assumed) -> Result:
    """Both methods on 15 goals with four seeds, by the planner and in truth, over the gains."""
    rule = assumed["success_rule"]
    table, better = better_cells(rule)
    rows = []
    for (points, ratio), cells in table[table.branch == _BRANCH].groupby(
        ["control_points", "gain_ratio"]
    ):
        for method, variant in METHODS.items():
            row = {"control points": points, "eta_0/zeta": ratio, "method": method}
            for judged in ("planner", "truth"):
                made = rate_of(cells[f"{variant}_{judged}"], cells.goals)
                row[judged] = f"{made['successes']}/{made['of']}"
                row[f"{judged}_low"], row[f"{judged}_high"] = made["low"], made["high"]
            rows.append(row)
    shown = pd.DataFrame(rows)
    face = shown[(shown["control points"] == _POINTS) & (shown["eta_0/zeta"] == ETA0 / ZETA)]
    face = {row["method"]: row for row in face.to_dict("records")}
    obtained = {
        "goals": int(table.goals.min()),
        "better": {"count": int(better.sum()), "of": len(table)},
        "seeds": sorted(int(seed) for seed in table.goal_seed.unique()),
        "judged_by": JUDGED_BY[rule],
        "face_value": face,
    }
    return Result(
        obtained=obtained,
        table=shown,
        caption=(
            f"{table.goals.min()} goals with each of {table.goal_seed.nunique()} seeds. With the "
            "printed gains "
            + "; ".join(
                f"the {method} search arrives at {row['planner']} by the planner, {row['truth']} "
                "in truth"
                for method, row in face.items()
            )
            + f". Judged by the {JUDGED_BY[rule]}, the improved search does better in "
            f"{better.mean():.0%} of {len(table)} choices of gains, posture, control points and "
            "goals. The printed numbers are lost."
        ),
        alt="Success rates of the search variants over the ratio of repulsive to attractive gain, "
        "by the "
        "planner and in truth, with bands of uncertainty and the printed ratio marked.",
        figure=_sweep_figure,
        witnesses=_cell_witnesses("qiu.tab02", obtained, table, better, rule),
    )


def _cell_witnesses(
    item_id: str, obtained: dict[str, Any], table: pd.DataFrame, better: pd.Series, rule: str
) -> list[dict[str, Any]]:
    judged = JUDGED_BY[rule]
    return witnesses(
        item_id, obtained, table, better, (*_SHOWN, f"traditional_{judged}", f"VAB_{judged}")
    )


def _sweep_figure() -> Any:
    table = ABLATION.load()
    table = table[(table.branch == _BRANCH) & (table.control_points == _POINTS)]
    ratios = sorted(table.gain_ratio.unique())
    panels: dict[str, dict[str, list[tuple[float, float, float]]]] = {}
    for judged in ("planner", "truth"):
        curves = {}
        for variant in ("traditional", "V", "A", "B", "VAB"):
            curves[variant] = []
            for ratio in ratios:
                rows = table[table.gain_ratio == ratio]
                found = rate_of(rows[f"{variant}_{judged}"], rows.goals)
                curves[variant].append((found["rate"], found["low"], found["high"]))
        panels[{"planner": "by the planner", "truth": "in truth"}[judged]] = curves
    return rate_figure(ratios, panels, "eta_0 / zeta", (ETA0 / ZETA, "printed"))


@checks(
    "qiu.claim_success_rate",
    rules=[
        _HIGHER,
        Generally(
            "smoother_joints",
            "goals with the smoother path of the improved method, in joint space",
            at_least="half",
            margin="margin",
        ),
        Generally(
            "smoother_tip",
            "goals with the smoother path of the improved method, in task space",
            at_least="half",
            margin="margin",
        ),
        Bounded(
            "singular_value",
            "smallest singular value of the position Jacobian on the way [m/rad]",
            low="regular",
        ),
    ],
)
def success_and_smoothness(assumed: Assumed) -> Result:
    """Success over the ablation; smoothness of both methods on one set of goals, each path cut
    where it rests and smoothed by the same spline; distance of the position from singularity."""
    if assumed["baseline"] != "same_potentials":
        raise ValueError("the traditional search shares the potentials")
    rule = assumed["success_rule"]
    table, better = better_cells(rule)
    goals = draw_goals(assumed, SEED)
    rows, least = [], np.inf
    for q in goals.q:
        plans = [plan_to(assumed, variant, q) for variant in _PAIR]
        paths = [_until_rest(plan) for plan in plans]
        if not plans[1].reached or min(map(len, paths)) < _SHORTEST:
            continue
        arm = master_arm(assumed).arm
        traditional, improved = (
            smoothed(path, assumed["smoothing_weight"], assumed["end_weight"]) for path in paths
        )
        sigma = np.linalg.svd(arm.jacobian(improved)[:, :3], compute_uv=False)[:, -1]
        least = min(least, float(sigma.min()))
        rows.append(
            {
                f"{method}_{space}": bending(points, spacing)
                for method, path in (("traditional", traditional), ("improved", improved))
                for space, points, spacing in (
                    ("joints", path, ALPHA0),
                    ("tip", arm.positions(path), ALPHA0 * reach()),
                )
            }
        )
    shown = pd.DataFrame(rows, columns=_COLUMNS)
    smoother = {s: shown[f"improved_{s}"] < shown[f"traditional_{s}"] for s in _SPACES}
    ratios = {s: float((shown[f"improved_{s}"] / shown[f"traditional_{s}"]).median())
              for s in _SPACES}  # fmt: skip
    at_start = float(np.linalg.svd(placed("master").arm.jacobian(START), compute_uv=False)[-1])
    obtained = {
        "better": {"count": int(better.sum()), "of": len(table)},
        **{f"smoother_{s}": {"count": int(smoother[s].sum()), "of": len(shown)} for s in _SPACES},
        "singular_value": least if len(shown) else None,
        "bending_ratio": ratios,
        "judged_by": JUDGED_BY[rule],
        "singular_value_at_the_printed_start": at_start,
    }
    return Result(
        obtained=obtained,
        table=shown,
        caption=(
            f"Judged by the {JUDGED_BY[rule]}, the improved method has the higher rate in "
            f"{better.mean():.0%} of {len(table)} cells of the ablation. On {len(shown)} goals, "
            "both paths cut where they rest and smoothed alike, its path bends less per length in "
            f"{int(smoother['joints'].sum())} of them in joint space and in "
            f"{int(smoother['tip'].sum())} in task space; the median ratio of the mean squared "
            f"curvature is {ratios['joints']:.2g} and {ratios['tip']:.2g}. The smallest singular "
            f"value of the position Jacobian on the way is {least:.3f} m/rad. At the printed "
            f"start, all joints zero, the smallest of the whole Jacobian is {at_start:.0e}, since "
            "axes 4 and 6 are aligned there."
        ),
        witnesses=_cell_witnesses("qiu.claim_success_rate", obtained, table, better, rule),
    )


def _until_rest(plan: SearchPlan) -> np.ndarray:
    """The path of a search, a failed one only as far as where it rests."""
    if plan.reached:
        return plan.path
    return plan.path[: until_rest(plan.path, ALPHA0) + 1]


@checks(
    "qiu.claim_local_min",
    rules=[
        Generally(
            "rescued",
            "midway minima of the one-way search that the search from both ends solves",
            at_least="noticeable",
            margin="margin",
        ),
    ],
)
def local_minima(assumed: Assumed) -> Result:
    """Failures with and without renewed goals in random scenes, by where the run ended."""
    judged = JUDGED_BY[assumed["success_rule"]]
    ratio = nearest(assumed["gain_ratio"], SCENE_RATIOS)
    table = SCENES.load()
    failure = table[f"traditional_{ratio:g}_failure"]
    kinds = {kind: table[failure == str(kind)] for kind in Failure}
    solved = {kind: rows[f"B_{ratio:g}_{judged}"].astype(bool) for kind, rows in kinds.items()}
    minima, rescued = kinds[Failure.MIDWAY_MINIMUM], solved[Failure.MIDWAY_MINIMUM]
    obtained = {
        "rescued": {"count": int(rescued.sum()), "of": len(minima)},
        "scenes": len(table),
        "ratio": ratio,
        "judged_by": judged,
        "failures": {str(kind): len(rows) for kind, rows in kinds.items()},
        "solved_from_both_ends": {str(k): int(found.sum()) for k, found in solved.items()},
    }
    return Result(
        obtained=obtained,
        caption=(
            f"In {len(table)} random scenes at eta_0/zeta = {ratio:g} the one-way search fails "
            + ", ".join(f"{len(rows)} times as {kind}" for kind, rows in kinds.items())
            + f"; judged by the {judged}, the search from both ends solves "
            + ", ".join(f"{int(found.sum())} of the {kind}" for kind, found in solved.items())
            + "."
        ),
        witnesses=witnesses("qiu.claim_local_min", obtained, minima, rescued, ("scene", "spheres")),
    )
