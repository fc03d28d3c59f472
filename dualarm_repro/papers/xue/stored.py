"""What the stored studies of `xue` say: shares with their intervals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY
from ...tracking import memo
from ...view.shares import Share
from .ablation import ABLATION, NAMED
from .comparison import COMPARISON
from .layout import Layout
from .lottery import LOTTERY
from .minima import MINIMA
from .repeated import REPEATED
from .trap_counts import text_counts
from .trials import METHODS, wilson


def share(count: float, runs: float) -> Share:
    """An observed share with its 95 % interval after Wilson."""
    return Share(float(count) / float(runs), *wilson(int(count), int(runs)))


@memo()
def lottery_table() -> pd.DataFrame:
    """One row per random arrangement in which Fig. 9 holds."""
    return LOTTERY.load()


def missed(method: str) -> np.ndarray:
    """Runs of ten that miss the goal, per arrangement; ``end_effector`` is the usual reading."""
    return lottery_table()[f"{column_of(method)}_missed"].to_numpy()


def held(method: str) -> np.ndarray:
    """Runs of ten that stand still and stay after small pushes, per arrangement."""
    return lottery_table()[f"{column_of(method)}_held"].to_numpy()


def column_of(method: str) -> str:
    """Columns of a method; ``end_effector`` is the usual reading of the traditional one."""
    return "traditional" if method == "end_effector" else method


def outcomes_of_table_2(reading: str) -> dict[str, np.ndarray]:
    """In which arrangements the outcomes of Table 2 show, (N,) of bool each.

    ``text``: at least as many traditional runs as the text prints are held in a trap, and no
    improved run misses the goal. ``table``: the same with the methods exchanged, as in the rows.
    """
    old, new = missed(reading), missed("improved")
    many = max(text_counts().values())
    return {
        "text": (held(reading) >= many) & (new == 0),
        "table": (held("improved") >= many) & (old == 0),
        "traditional_mostly_held": held(reading) >= many,
        "improved_never_missed": new == 0,
        "both_never_missed": (old == 0) & (new == 0),
    }


def lottery_shares(reading: str) -> dict[str, Share]:
    """How often these outcomes show; ``reading`` of the traditional method."""
    found = outcomes_of_table_2(reading)
    return {name: share(mask.sum(), len(mask)) for name, mask in found.items()}


def choice(index: int, verdict: str, **judged: Any) -> dict[str, Any]:
    """An arrangement of the lottery as a witness: its values and what was seen there."""
    row = lottery_table().loc[index]
    values = {field.name: _plain(row[field.name]) for field in fields(Layout)}
    where = f"arrangement {index} of {LOTTERY.name}"
    return {"choice": where, "verdict": verdict, "values": values, "judged": judged}


def is_declared(table: pd.DataFrame) -> np.ndarray:
    """Which arrangements lie within the declared ranges, (N,) of bool."""
    inside = np.ones(len(table), dtype=bool)
    for field in fields(Layout):
        declared = REGISTRY.declared(f"xue.{field.name}", "range").range
        if declared is not None:
            inside &= table[field.name].between(*declared).to_numpy()
    return inside


def _plain(found: Any) -> Any:
    return found.item() if isinstance(found, np.generic) else found


def held_share(method: str = "traditional") -> Share:
    """Share of the runs that stand still which stay after small pushes too."""
    table = lottery_table()
    return share(table[f"{method}_held"].sum(), table[f"{method}_trapped"].sum())


@memo()
def comparison_table() -> pd.DataFrame:
    """Starts in contact and paths, one row per arrangement of the lottery."""
    return COMPARISON.load()


def starts_clear() -> np.ndarray:
    """Arrangements of the lottery in which no start of a trial touches an obstacle, (N,)."""
    return (comparison_table()["touching_five_points"] == 0).to_numpy()


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
