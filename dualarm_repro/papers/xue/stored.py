"""What the stored studies of `xue` say: shares with their intervals."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from ...tracking import memo
from ...view.shares import Share
from .ablation import ABLATION, NAMED
from .lottery import LOTTERY
from .minima import MINIMA
from .repeated import REPEATED
from .trials import METHODS, wilson

#: Table 2 by the text: this many traditional runs miss, and no improved one.
MANY_MISSED = 7


def share(count: float, runs: float) -> Share:
    """An observed share with its 95 % interval after Wilson."""
    return Share(float(count) / float(runs), *wilson(int(count), int(runs)))


@memo()
def lottery_table() -> pd.DataFrame:
    """One row per random arrangement in which Fig. 9 holds."""
    return LOTTERY.load()


def missed(method: str) -> np.ndarray:
    """Runs of ten that miss the goal, per arrangement; ``end_effector`` is the usual reading."""
    column = {"end_effector": "traditional"}.get(method, method)
    return lottery_table()[f"{column}_missed"].to_numpy()


def lottery_shares(reading: str) -> dict[str, Share]:
    """How often the outcomes of Table 2 show; ``reading`` of the traditional method.

    ``text``: at least 7 of 10 traditional and no improved runs miss. ``table``: the same with the
    methods exchanged, as the rows are printed.
    """
    old, new = missed(reading), missed("improved")
    outcomes = {
        "text": (old >= MANY_MISSED) & (new == 0),
        "table": (new >= MANY_MISSED) & (old == 0),
        "traditional_mostly_missed": old >= MANY_MISSED,
        "improved_never_missed": new == 0,
        "both_never_missed": (old == 0) & (new == 0),
        "both_mostly_missed": (old >= MANY_MISSED) & (new >= MANY_MISSED),
    }
    return {name: share(mask.sum(), len(mask)) for name, mask in outcomes.items()}


def held_share(method: str = "traditional") -> Share:
    """Share of the runs that stand still which stay after small pushes too."""
    table = lottery_table()
    return share(table[f"{method}_held"].sum(), table[f"{method}_trapped"].sum())


def successful() -> pd.DataFrame:
    """Arrangements in which the end effectors also do what Figs 8, 10 and 11 show."""
    table = lottery_table()
    arrived = (table["slave_reason"] == "reached") & (table["master_distance"] > 0.0)
    apart = table["flanges_apart"] > table["meeting_distance"]
    return table[arrived & apart & (table["slave_flange_window"] > 0.0)]


def clear_share(radius: float, *pairs: str) -> Share:
    """Share of these in which the links of that radius stay clear.

    ``pairs`` are among ``slave_window``, ``master_window`` and ``arms``; none means all.
    """
    table = successful()
    clear = np.ones(len(table), dtype=bool)
    for pair in pairs or ("slave_window", "master_window", "arms"):
        width = 2.0 * radius if pair == "arms" else radius
        clear &= table[f"cores_{pair}"].to_numpy() > width
    return share(clear.sum(), len(clear))


@memo()
def repeated_shares() -> Mapping[str, Mapping[str, Share]]:
    """Share of trials in the nominal arrangement that miss, by rule of the step and method."""
    table = REPEATED.load()
    return {
        rule: {
            method: share(rows[f"{method}_missed"].sum(), rows[f"{method}_runs"].sum())
            for method in ("traditional", "improved", "without_virtual")
        }
        for rule, rows in table.groupby("update_rule", sort=False)
    }


@memo()
def ablation_shares() -> Mapping[str, Mapping[str, Share]]:
    """Share of trials that miss, by method, over the random arrangements and in the named ones."""
    table = ABLATION.load()
    groups = {"random arrangements": table[~table["layout"].isin(NAMED)]}
    groups |= {name: table[table["layout"] == name] for name in NAMED}
    return {
        ablation.title: {
            group: share(rows[f"{method}_missed"].sum(), rows[f"{method}_runs"].sum())
            for group, rows in groups.items()
        }
        for method, ablation in METHODS.items()
    }


@memo()
def minima_shares() -> dict[float, Share]:
    """Share of random pairs whose descent rests in a minimum elsewhere, by weight."""
    table = MINIMA.load().groupby("weight")[["pairs", "minima"]].sum()
    return {float(weight): share(row.minima, row.pairs) for weight, row in table.iterrows()}


def virtual_point_counts() -> dict[str, Any]:
    """Over the lottery: trials in which the virtual point acted, and in which it saved the run."""
    table = lottery_table()
    runs = int(table["improved_runs"].sum())
    used, rescued = int(table["improved_used"].sum()), int(table["improved_rescued"].sum())
    return {"runs": runs, "used": used, "rescued": rescued}
