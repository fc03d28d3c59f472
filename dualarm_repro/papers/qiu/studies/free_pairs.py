"""Stored study of `qiu`: which readings move both arms to the printed goals without contact."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import alternatives
from ..document import SEED
from ..reading import CONTROL_POINTS, Slave
from .fit import combinations, reading_of

RATIOS = (1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 1.0)
BRANCHES = ("front_shallow", "front_deep")
#: Distance that a motion has to keep to be called free [m], the accuracy to which links are round.
MARGIN = 0.01


def _cells() -> list[dict[str, Any]]:
    return combinations(
        goal_branch=BRANCHES,
        control_points=list(CONTROL_POINTS),
        adaptive_step=alternatives("qiu.adaptive_step", 0),
        floor=alternatives("qiu.floor", 0),
        gain_ratio=RATIOS,
    )


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Both arms by one reading, judged by whole links, spheres and, where it stands, the table."""
    reading = Slave.nominal(**cell)
    plan = reading.dual_plan()
    row: dict[str, Any] = {"joined": plan.reached, "searches": plan.slave.searches}
    row |= dict.fromkeys(("arms", "obstacles", "self", "floor_distance", "beyond_limits"), np.nan)
    row["smallest"], row["free"] = np.nan, False
    if plan.reached:
        check = plan.contact(reading.scene())
        groups = {"floor": "floor_distance"}
        row |= {groups.get(key, key): value for key, value in check.clearance.items()}
        row |= {"smallest": check.smallest, "beyond_limits": check.beyond_limits}
        row["free"] = bool(reading.is_free(check) and check.smallest >= MARGIN)
    return row


FREE = REGISTRY.keeps(
    Study(
        name="qiu_free_pairs",
        title="Readings that move both arms to the printed goals without contact",
        cells=_cells,
        compute=_cell,
        seed=SEED + 50,
        settings={"ratios": list(RATIOS), "margin_m": MARGIN},
    )
)


def free_reading() -> Slave:
    """Of the readings whose motion is free, above a table if there are such, the one that keeps
    the largest distance."""
    free = FREE.load().query("free")
    above = free[free["floor"] != "none"]
    chosen = above if len(above) else free
    return reading_of(chosen.loc[chosen["smallest"].idxmax()], Slave)
