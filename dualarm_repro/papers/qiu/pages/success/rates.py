"""Table 2 of `qiu`, the claims on success and minima, and tables of its studies."""

from __future__ import annotations

from functools import partial
from typing import Any

import pandas as pd

from .....ledger import REGISTRY, Assumed, Generally, NoOriginal, Result, Rounds
from .....ledger.captions import captions
from .....ledger.shares import Share
from .....ledger.witnesses import cell_witnesses
from .....planning.search.failure import Failure
from .....planning.search.variants import VARIANTS
from .....planning.trials.yardstick import YARDSTICK
from .....view.shares import shares_figure
from .....view.success_curves import rate_figure
from .....view.success_table import judged_share, success_row
from ...document import PRINTED
from ...reading import JUDGED_BY
from ...studies.ablation import ABLATION
from ...studies.dual_pairs import PAIR_POINTS, PAIR_RATIOS, PAIRS
from ...studies.improvements import nearest
from ...studies.random_scenes import SCENE_RATIOS, SCENES

checks = partial(REGISTRY.checks, page="qiu/success")
caption = captions(__file__)
#: Columns of the studies of both methods that the document compares.
COMPARED = {"traditional": "traditional", "improved": "VAB"}
_BRANCH, _POINTS = "front_shallow", "elbow_wrist_flange"


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
    groups = table[table.branch == _BRANCH].groupby(["control_points", "gain_ratio"])
    for (points, ratio), cells in groups:
        for method, variant in COMPARED.items():
            row = {"control points": points, "eta_0/zeta": ratio, "method": method}
            for judged in ("planner", "truth"):
                kept, tried = int(cells[f"{variant}_{judged}"].sum()), int(cells.goals.sum())
                row[judged] = f"{kept}/{tried}"
                _, row[f"{judged}_low"], row[f"{judged}_high"] = Share.of(kept, tried)
            rows.append(row)
    shown = pd.DataFrame(rows)
    face = shown[(shown["control points"] == _POINTS) & (shown["eta_0/zeta"] == _printed_ratio())]
    obtained = {
        "goals": int(table.goals.min()),
        "better": {"count": int(better.sum()), "of": len(table)},
        "seeds": sorted(int(seed) for seed in table.goal_seed.unique()),
        "judged_by": JUDGED_BY[rule],
        "face_value": {row["method"]: row for row in face.to_dict("records")},
    }
    return Result(
        obtained=obtained,
        table=shown,
        caption=caption("tab02"),
        alt="Success rates of the search variants over the ratio of repulsive to attractive gain, "
        "by the planner and in truth, with bands of uncertainty and the printed ratio marked.",
        figure=_sweep_figure,
        witnesses=_cell_witnesses("qiu.tab02", obtained, table, better, rule),
    )


def _cell_witnesses(
    item_id: str, obtained: dict[str, Any], table: pd.DataFrame, better: pd.Series, rule: str
) -> list[dict[str, Any]]:
    judged = JUDGED_BY[rule]
    return cell_witnesses(
        item_id, obtained, table, better, (*_SHOWN, f"traditional_{judged}", f"VAB_{judged}")
    )


def _printed_ratio() -> float:
    return PRINTED.eta0 / PRINTED.zeta


def _sweep_figure() -> Any:
    table = ABLATION.load()
    table = table[(table.branch == _BRANCH) & (table.control_points == _POINTS)]
    ratios = sorted(table.gain_ratio.unique())
    panels: dict[str, dict[str, list[Share]]] = {}
    for judged, title in (("planner", "by the planner"), ("truth", "in truth")):
        panels[title] = {}
        for variant in ("traditional", "V", "A", "B", "VAB"):
            cells = table.groupby("gain_ratio")[[f"{variant}_{judged}", "goals"]].sum()
            panels[title][variant] = [Share.of(*cells.loc[ratio]) for ratio in ratios]
    return rate_figure(ratios, panels, "eta_0 / zeta", (_printed_ratio(), "printed"))


@checks("qiu.claim_success_rate", rules=[_HIGHER])
def higher_rate(assumed: Assumed) -> Result:
    """Cells of the ablation in which the improved method has the higher rate."""
    rule = assumed["success_rule"]
    table, better = better_cells(rule)
    kept = {m: int(table[f"{v}_{JUDGED_BY[rule]}"].sum()) for m, v in COMPARED.items()}
    obtained = {
        "better": {"count": int(better.sum()), "of": len(table)},
        "kept": kept,
        "goals": int(table.goals.sum()),
        "judged_by": JUDGED_BY[rule],
    }
    return Result(
        obtained=obtained,
        caption=caption("claim_success_rate"),
        witnesses=_cell_witnesses("qiu.claim_success_rate", obtained, table, better, rule),
    )


@checks(
    "qiu.claim_local_min",
    rules=[
        Generally(
            "rescued",
            "midway minima of the one-way search that the search from both ends solves",
            at_least="noticeable",
            margin="margin",
        )
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
        caption=caption("claim_local_min"),
        witnesses=cell_witnesses(
            "qiu.claim_local_min", obtained, minima, rescued, ("scene", "spheres")
        ),
    )


def scenes_table() -> pd.DataFrame:
    """Rates of every variant in the random scenes [%], with 95 % intervals of the true ones, and
    how the one-sided variants failed."""
    table = SCENES.load()
    rows = [
        {"method": name, "eta_0/zeta": ratio} | success_row(table, f"{name}_{ratio:g}")
        for ratio in SCENE_RATIOS
        for name in (variant.name for variant in VARIANTS)
    ]
    return pd.DataFrame([*rows, {"method": "RRT-Connect"} | success_row(table, YARDSTICK)])


def scenes_figure() -> Any:
    """True rates of every variant in the random scenes, by the ratio of the gains."""
    table = SCENES.load()
    rows = {
        variant.name: {
            f"eta_0/zeta = {ratio:g}": judged_share(table, f"{variant.name}_{ratio:g}", "truth")
            for ratio in SCENE_RATIOS
        }
        for variant in VARIANTS
    }
    yardstick = judged_share(table, YARDSTICK, "truth").value
    return shares_figure(rows, "true success", (yardstick, "RRT-Connect"))


def pairs_table() -> pd.DataFrame:
    """Rates of master and slave on random pairs of goals [%], uniform or near the printed ones, by
    control points and gain ratio."""
    rows = []
    for drawn, table in PAIRS.load().groupby("drawn", sort=False):
        rows += [
            {"goals": drawn, "control points": points, "eta_0/zeta": ratio}
            | success_row(table, f"{points}_{ratio:g}")
            for points in PAIR_POINTS
            for ratio in PAIR_RATIOS
        ]
        yardstick = {"goals": drawn, "control points": "RRT-Connect"}
        rows.append(yardstick | success_row(table, YARDSTICK))
    return pd.DataFrame(rows)
