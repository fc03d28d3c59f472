"""What the stored studies of `xue` say: shares and means with intervals."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from ...ledger import REGISTRY
from ...ledger.shares import Share
from ...tracking import memo
from .document import Layout, text_counts
from .motions import PAIRS
from .outcomes import CRITERIA, READINGS, VARIANTS, variant_of
from .studies.ablation import ABLATION, NAMED
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
    """Runs of ten that stand still in a true minimum, per arrangement."""
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


def mean_share(part: pd.Series, whole: pd.Series) -> Share:
    """Mean over arrangements of the share ``part / whole`` of their runs, with its interval.

    The ten runs of one arrangement resemble each other, so that the arrangement is the unit: the
    interval is that of :func:`mean_with_interval`, within [0, 1]. Arrangements (N,) without such
    runs say nothing; with fewer than two that have some everything is possible.
    """
    found = (part / whole)[whole > 0]
    if len(found) < 2:
        return Share(float(found.mean()), 0.0, 1.0)
    mean = mean_with_interval(found.to_numpy())
    return Share(float(mean["value"]), max(0.0, mean["low"]), min(1.0, mean["high"]))


def _shares(rows: pd.DataFrame, method: str, part: str, whole: str) -> Share:
    return mean_share(rows[f"{method}_{part}"], rows[f"{method}_{whole}"])


def held_share(method: str) -> Share:
    """Share of an arrangement's runs that stand still which do so in a true minimum, on average."""
    return _shares(lottery_table(), method, "held", "trapped")


def missed_share(method: str) -> Share:
    """Share of an arrangement's runs that miss the goal, on average over the lottery."""
    return _shares(lottery_table(), method, "missed", "runs")


def _share(rows: pd.DataFrame, method: str, part: str, whole: str) -> Share:
    """The same over the runs of one arrangement, whose starts were drawn one by one."""
    return Share.of(rows[f"{method}_{part}"].sum(), rows[f"{method}_{whole}"].sum())


def clear_share(radius: float, *pairs: str) -> Share:
    """Share of the arrangements in which the links of that radius stay clear.

    ``pairs`` are among ``slave_window``, ``master_window`` and ``arms``; none means all.
    """
    table = lottery_table()
    clear = np.ones(len(table), dtype=bool)
    for pair in pairs or PAIRS:
        width = 2.0 * radius if pair == "arms" else radius
        clear &= table[f"cores_{pair}"].to_numpy() > width
    return Share.of(clear.sum(), len(clear))


class Cell(NamedTuple):
    """One cell of the matrix of Table 2: what print leaves open, and the shares found."""

    method: str
    criterion: str
    update_rule: str
    half_width: float
    runs: int
    missed: Share
    held: Share


@memo()
def table_2_matrix() -> tuple[Cell, ...]:
    """Every reading of the traditional method by either criterion, then the improved method."""
    cells = []
    for (rule, width), rows in REPEATED.load().groupby(["update_rule", "half_width"], sort=False):
        for method in (*map(variant_of, READINGS), "improved"):
            for criterion in CRITERIA:
                if method == "improved" and criterion == CRITERIA[0]:
                    continue
                tagged = method == "improved" or criterion == CRITERIA[0]
                name = method if tagged else f"{method}_{criterion}"
                shares = (_share(rows, name, part, "runs") for part in ("missed", "held"))
                count = int(rows[f"{name}_runs"].sum())
                cells.append(Cell(method, criterion, str(rule), float(width), count, *shares))
    return tuple(cells)


def touching_starts() -> dict[str, int]:
    """Starts that touched an obstacle and were left out, over the lottery and in the matrix."""
    columns = {"lottery": lottery_table(), "matrix": REPEATED.load()}
    return {name: int(table["starts_touching"].sum()) for name, table in columns.items()}


@memo()
def ablation_shares() -> Mapping[str, Mapping[str, Share]]:
    """Share of trials that miss, by method, over the random arrangements and in the named ones."""
    table = ABLATION.load()
    drawn = table[~table["layout"].isin(NAMED)]
    named = {name: table[table["layout"] == name] for name in NAMED}
    return {
        variant.title: {
            "random arrangements": _shares(drawn, method, "missed", "runs"),
            **{name: _share(rows, method, "missed", "runs") for name, rows in named.items()},
        }
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
