"""What the stored studies of `xue` say: shares and means with intervals."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from ...ledger import REGISTRY
from ...ledger.shares import Share
from ...tracking import memo
from .document import Layout, text_counts
from .motions import PAIRS
from .outcomes import VARIANTS, variant_of
from .studies.ablation import ABLATION, NAMED
from .studies.comparison import COMPARISON
from .studies.lottery import LOTTERY, lottery_table
from .studies.minima import MINIMA
from .studies.trials import REPEATED

#: 97.5 % point of the standard normal distribution.
_Z = 1.959963984540054


def mean_with_interval(values: np.ndarray) -> dict[str, float | int]:
    """Mean (N,), its 95 % interval mean +- 1.96 s / sqrt(N), and N.

    The sample of arrangements is large, so that its mean is close to normal.
    """
    values = np.asarray(values, dtype=float)
    mean, half = float(values.mean()), float(_Z * values.std(ddof=1) / np.sqrt(len(values)))
    return {"value": mean, "low": mean - half, "high": mean + half, "of": len(values)}


def missed(method: str) -> np.ndarray:
    """Runs of ten that miss the goal, per arrangement; ``end_effector`` is the usual reading."""
    return lottery_table()[f"{variant_of(method)}_missed"].to_numpy()


def held(method: str) -> np.ndarray:
    """Runs of ten that stand still and stay after small pushes, per arrangement."""
    return lottery_table()[f"{variant_of(method)}_held"].to_numpy()


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
    return {name: Share.of(mask.sum(), len(mask)) for name, mask in found.items()}


def choice(index: int, verdict: str, **judged: Any) -> dict[str, Any]:
    """An arrangement of the lottery as a witness: its values and what was seen there."""
    row = lottery_table().loc[index, list(Layout.names())]
    values = {k: v.item() if isinstance(v, np.generic) else v for k, v in row.items()}
    where = f"arrangement {index} of {LOTTERY.name}"
    return {"choice": where, "verdict": verdict, "values": values, "judged": judged}


def is_declared(table: pd.DataFrame) -> np.ndarray:
    """Which arrangements lie within the declared ranges, (N,) of bool."""
    inside = np.ones(len(table), dtype=bool)
    for name in Layout.names():
        declared = REGISTRY.declared(f"xue.{name}", "range").range
        if declared is not None:
            inside &= table[name].between(*declared).to_numpy()
    return inside


def _share(rows: pd.DataFrame, method: str, part: str, whole: str) -> Share:
    return Share.of(rows[f"{method}_{part}"].sum(), rows[f"{method}_{whole}"].sum())


def held_share(method: str) -> Share:
    """Share of the runs that stand still which stay after small pushes too."""
    return _share(lottery_table(), method, "held", "trapped")


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
    for pair in pairs or PAIRS:
        width = 2.0 * radius if pair == "arms" else radius
        clear &= table[f"cores_{pair}"].to_numpy() > width
    return Share.of(clear.sum(), len(clear))


@memo()
def repeated_shares() -> Mapping[str, Mapping[str, Share]]:
    """Share of trials in the nominal arrangement that miss, by rule of the step and method."""
    methods = ("traditional", "improved", "without_virtual")
    return {
        rule: {method: _share(rows, method, "missed", "runs") for method in methods}
        for rule, rows in REPEATED.load().groupby("update_rule", sort=False)
    }


@memo()
def ablation_shares() -> Mapping[str, Mapping[str, Share]]:
    """Share of trials that miss, by method, over the random arrangements and in the named ones."""
    table = ABLATION.load()
    groups = {"random arrangements": table[~table["layout"].isin(NAMED)]}
    groups |= {name: table[table["layout"] == name] for name in NAMED}
    return {
        variant.title: {k: _share(rows, method, "missed", "runs") for k, rows in groups.items()}
        for method, variant in VARIANTS.items()
    }


@memo()
def minima_shares() -> dict[float, Share]:
    """Share of random pairs whose descent rests in a minimum elsewhere, by weight."""
    table = MINIMA.load().groupby("weight")[["pairs", "minima"]].sum()
    return {float(weight): Share.of(row.minima, row.pairs) for weight, row in table.iterrows()}


def virtual_point_counts() -> dict[str, int]:
    """Over the lottery: trials in which the virtual point acted, and in which it saved the run."""
    table = lottery_table()
    return {name: int(table[f"improved_{name}"].sum()) for name in ("runs", "used", "rescued")}
