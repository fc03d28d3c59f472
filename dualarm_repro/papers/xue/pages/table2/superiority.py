"""The conclusion of `xue`: the improved method is superior in four respects, over arrangements."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Exceeds, Result
from .....ledger.captions import captions
from .....ledger.shares import Share
from .....view.shares import shares_figure
from ...outcomes import TRIALS, variant_of
from ...stored import (
    choice,
    is_declared,
    lottery_table,
    mean_with_interval,
)

checks = partial(REGISTRY.checks, page="xue/table2")
caption = captions(__file__)

#: What each respect is measured by, in words for a caption.
_MEASURES = {
    "ability": "runs of ten missed fewer",
    "robustness": "share of arrangements without a miss, gained",
    "quality": "logarithm of the path saved",
    "efficiency": "logarithm of the steps saved",
}


@checks(
    "xue.claim_better",
    rules=[Exceeds(name, f"{name}: {words}", threshold=name) for name, words in _MEASURES.items()],
)
def superior(assumed: Assumed) -> Result:
    """Mean paired differences of the two methods over random arrangements."""
    reading, path = assumed["classical_method"], assumed["path_quality"]
    differences = paired_differences(reading, path)
    found = {name: mean_with_interval(column.dropna()) for name, column in differences.items()}
    table = lottery_table()
    methods = {"traditional": variant_of(reading), "improved": "improved"}
    columns = {name: table[f"{method}_missed"] for name, method in methods.items()}
    never = {name: Share.of((column == 0).sum(), len(table)) for name, column in columns.items()}
    return Result(
        obtained={
            **found,
            "arrangements": len(table),
            "starts_left_out": int(table["starts_touching"].sum()),
            "mean_missed": {name: float(column.mean()) for name, column in columns.items()},
            "never_missed": {name: value._asdict() for name, value in never.items()},
        },
        table=differences.reset_index(names="arrangement"),
        caption=caption(
            "claim_better", trials=TRIALS, path=path, measures=_MEASURES, found=found, least=least()
        ),
        alt="Bars with intervals: share of arrangements without a missed run, for both methods.",
        figure=lambda: shares_figure(
            {name: {"no run missed": value} for name, value in never.items()},
            "share of random arrangements",
        ),
        witnesses=_witnesses(differences, found),
    )


def least() -> dict[str, float]:
    """What an advantage has to exceed, by respect."""
    declared = REGISTRY.look("xue.claim_better").thresholds
    return {name: float(declared[name].value) for name in _MEASURES}


def paired_differences(reading: str, path: str) -> pd.DataFrame:
    """Advantage of the improved method in every arrangement; no start is in contact.

    Path and steps are compared where both methods arrive; elsewhere they are NaN.

    Parameters
    ----------
    path
        ``tool_path`` or ``joint_path``: whose length counts.
    """
    table, old = lottery_table(), variant_of(reading)
    never = {name: (table[f"{name}_missed"] == 0).astype(float) for name in (old, "improved")}
    return pd.DataFrame(
        {
            "ability": table[f"{old}_missed"] - table["improved_missed"],
            "robustness": never["improved"] - never[old],
            "quality": np.log(table[f"{old}_{path}"] / table[f"improved_{path}"]),
            "efficiency": np.log(table[f"{old}_steps_reached"] / table["improved_steps_reached"]),
        }
    )


def _witnesses(differences: pd.DataFrame, found: dict[str, dict[str, Any]]) -> list[dict[str, Any]]:
    """Where nothing fails and something is open: a declared arrangement for each side of it."""
    edges = least()
    if any(one["high"] < edges[name] for name, one in found.items()):
        return []
    declared = is_declared(lottery_table().loc[differences.index])
    witnesses = []
    for name, one in found.items():
        if one["low"] <= edges[name]:
            column = differences[name].where(declared)
            for k, verdict in ((column.idxmax(), "holds"), (column.idxmin(), "fails")):
                witnesses.append(choice(int(k), verdict, **{name: float(column[k])}))
    return witnesses
