"""Tables and figures of the stored studies of `qiu`."""

from __future__ import annotations

from typing import Any

import pandas as pd

from ...view.success_curves import bar_figure
from .campaign import rate
from .readings import VARIANTS
from .studies import PAIR_POINTS, PAIR_RATIOS, PAIRS, SCENE_RATIOS, SCENES

_NAMES = [variant.name for variant in VARIANTS]
_YARDSTICK = "rrt_connect"


def scenes_table() -> pd.DataFrame:
    """Rates of every variant in the random scenes [%], with 95 % intervals of the true ones, and
    how the one-sided variants failed."""
    table = SCENES.load()
    rows = [
        {"method": name, "eta_0/zeta": ratio} | _rates(table, f"{name}_{ratio:g}")
        for ratio in SCENE_RATIOS
        for name in _NAMES
    ]
    return pd.DataFrame([*rows, {"method": "RRT-Connect"} | _rates(table, _YARDSTICK)])


def scenes_figure() -> Any:
    """True rates of every variant in the random scenes, by the ratio of the gains."""
    table = SCENES.load()
    groups = {
        f"eta_0/zeta = {ratio:g}": {n: float(table[f"{n}_{ratio:g}_truth"].mean()) for n in _NAMES}
        for ratio in SCENE_RATIOS
    }
    yardstick = 100.0 * table[f"{_YARDSTICK}_truth"].mean()
    return bar_figure(groups, "true success [%]", (yardstick, "RRT-Connect"))


def pairs_table() -> pd.DataFrame:
    """Rates of master and slave on random pairs of goals [%], by control points and gain ratio."""
    table = PAIRS.load()
    rows = [
        {"control points": points, "eta_0/zeta": ratio} | _rates(table, f"{points}_{ratio:g}")
        for points in PAIR_POINTS
        for ratio in PAIR_RATIOS
    ]
    return pd.DataFrame([*rows, {"control points": "RRT-Connect"} | _rates(table, _YARDSTICK)])


def _rates(table: pd.DataFrame, key: str) -> dict[str, Any]:
    planner, truth = (rate(table[f"{key}_{judged}"].tolist()) for judged in ("planner", "truth"))
    row = {
        "planner %": round(100 * planner["rate"], 1),
        "true %": round(100 * truth["rate"], 1),
        "true low %": round(100 * truth["low"], 1),
        "true high %": round(100 * truth["high"], 1),
    }
    if f"{key}_failure" in table:
        counts = table[f"{key}_failure"].value_counts()
        row |= {kind: int(counts.get(kind, 0)) for kind in ("displaced-goal", "midway-minimum")}
    return row | {"of": len(table)}
