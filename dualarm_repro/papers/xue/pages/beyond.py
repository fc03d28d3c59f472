"""Beyond `xue`: other planners in the same scene, several obstacles, whole links as the judge."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from ....arms.counted_inverse import counting_inverse
from ....ledger import REGISTRY, Assumed, Exceeds, Is, Result
from ....ledger.captions import captions
from ....ledger.shares import Share
from ....planning.descent.apf import plan_apf
from ....tracking import memo
from ....view.shares import shares_figure
from ..motions import slave_task
from ..outcomes import VARIANTS
from ..reading import nominal
from ..stored import mean_with_interval
from ..studies.planners import METHODS, PLANNERS

checks = partial(REGISTRY.checks, page="xue/beyond")
caption = captions(__file__)


@memo()
def planners_table() -> pd.DataFrame:
    """One row per scene: what each planner comes to; nothing of one that never arrives."""
    table = PLANNERS.load()
    found = [f"{name}_{what}" for name in METHODS for what in ("free", "clearance", "tool_path")]
    return table.reindex(columns=list(dict.fromkeys([*table, *found])))


@checks(
    "xue.claim_efficient",
    rules=[
        Is("inverse", "calls of inverse kinematics in the steps of a plan", value=0),
        Exceeds(
            key="saved",
            label="logarithm of the postures that RRT-Connect checks over those the field looks at",
            threshold="cheaper",
        ),
    ],
)
def efficient(assumed: Assumed) -> Result:
    """Postures looked at by the method as printed and by RRT-Connect, where the method arrives."""
    table = planners_table()
    arrived = table[table["points_arrives"].astype(bool)]
    effort = {
        name: np.log(arrived[f"{name}_effort"] / arrived["points_effort"])
        for name in ("rrt_in_turn", "rrt_both")
    }
    found = {name: mean_with_interval(column) for name, column in effort.items()}
    cheapest = min(found, key=lambda name: found[name]["value"])
    return Result(
        obtained={
            "inverse": _inverse_calls(),
            "saved": found[cheapest],
            "against": cheapest,
            "scenes": len(arrived),
            "median": {name: float(arrived[f"{name}_effort"].median()) for name in METHODS},
            "free": {name: share._asdict() for name, share in _free().items()},
        },
        table=arrived,
        caption=caption("claim_efficient", **_factors(found[cheapest])),
        alt="Bars with intervals: share of scenes with a motion that is certified free, by planner "
        "and number of obstacles added.",
        figure=lambda: shares_figure(free_by_obstacles(), "share of scenes with a free motion"),
    )


def _factors(found: dict[str, Any]) -> dict[str, float]:
    """A mean logarithm and its ends as factors."""
    names = {"factor": "value", "low": "low", "high": "high"}
    return {name: float(np.exp(found[key])) for name, key in names.items()}


def _inverse_calls() -> int:
    """Calls of the closed-form inverse while a plan of the slave is made from its angles.

    The compiled descent never calls Python, so that the plain one, which does the same, is counted.
    """
    case = nominal()
    placed, obstacles = slave_task(case)
    inner, calls = counting_inverse(placed.arm)
    counted = replace(placed, arm=inner)
    settings = VARIANTS["improved"].settings(case)
    plan_apf(counted, placed.start, placed.goal, obstacles, settings)
    return len(calls)


def _free() -> dict[str, Share]:
    table = planners_table()
    return {name: Share.of(_count(table, name), len(table)) for name in METHODS}


def free_by_obstacles() -> dict[str, dict[str, Share]]:
    """Share of scenes with a motion certified free, by number of obstacles and planner."""
    table = planners_table()
    return {
        f"window and {count} more" if count else "the window alone": {
            title: Share.of(_count(rows, name), len(rows)) for name, title in METHODS.items()
        }
        for count, rows in table.groupby("spheres")
    }


def _count(table: pd.DataFrame, name: str) -> int:
    return int((table[f"{name}_free"] == True).sum())  # noqa: E712 (a missing value is no motion)


def comparison_frame() -> pd.DataFrame:
    """What each planner comes to over all scenes, one row each."""
    table, rows = planners_table(), []
    for name, title in METHODS.items():
        arrives = table[f"{name}_arrives"].astype(bool)
        rows.append({
            "planner": title,
            "arrives": f"{int(arrives.sum())} of {len(table)}",
            "certified free": f"{_count(table, name)} of {len(table)}",
            "clearance, median [m]": float(table[f"{name}_clearance"].median()),
            "tool paths, median [m]": float(table[f"{name}_tool_path"].median()),
            "postures, median": float(table.loc[arrives, f"{name}_effort"].median()),
        })  # fmt: skip
    return pd.DataFrame(rows)
