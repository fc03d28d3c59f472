"""Stored study of `qiu`: a declared fit of the master's search to what is printed of it.

Per branch, wrist, set of control points and law of the step, every order of the updates, radius of
the goal and ratio of the gains is tried. Kept is how many were tried, how many joined, how many of
those took the printed number of searches, and of these the one whose ends come nearest to print.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import product
from json import loads
from typing import Any, TypeVar

import numpy as np
import pandas as pd

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import alternatives, hashable
from ....ledger.printed_values import printed_numbers
from ....planning.search.search_plan import SearchPlan
from ..document import PRINTED, SEED
from ..reading import CONTROL_POINTS, Improved, Reading

R = TypeVar("R", bound=Reading)

RATIOS = tuple(float(f"{x:.2e}") for x in np.geomspace(1e-5, 1.0, 21))
RADII = (0.61, 0.63, 0.65)
BRANCHES = ("front_shallow", "front_deep")
ORDERS = ("before", "after")
#: Assumptions that the best reading of a cell chooses.
CHOSEN = ("update_order", "goal_radius", "gain_ratio")


def combinations(**named: Any) -> list[dict[str, Any]]:
    """Cells of a grid over these choices."""
    return [dict(zip(named, values, strict=True)) for values in product(*named.values())]


def wrists(name: str) -> list[list[float]]:
    """The declared wrist angles of an assumption."""
    return alternatives(f"qiu.{name}", 0)


def _cells() -> list[dict[str, Any]]:
    return combinations(
        goal_branch=BRANCHES,
        goal_wrist=wrists("goal_wrist"),
        control_points=list(CONTROL_POINTS),
        adaptive_step=alternatives("qiu.adaptive_step", 0),
    )


def _readings(cell: Mapping[str, Any]) -> Iterator[Improved]:
    base = Improved.nominal(**{key: hashable(value) for key, value in cell.items()})
    for order, radius, ratio in product(ORDERS, RADII, RATIOS):
        yield replace(base, update_order=order, goal_radius=radius, gain_ratio=ratio)


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    printed = printed_numbers("qiu.claim_bi_counts", "forward", "backward")
    tally = Tally(PRINTED.meeting, int(printed[0]))
    for reading in _readings(cell):
        tally.take(reading.plan(), {key: getattr(reading, key) for key in CHOSEN})
    return tally.row


class Tally:
    """Counts readings that were tried, and keeps the one that comes nearest to print.

    Parameters
    ----------
    ends
        Printed ends of the halves (2, 3) [m].
    searches
        Printed number of searches.
    """

    def __init__(self, ends: np.ndarray, searches: int) -> None:
        self._ends, self._searches = ends, searches
        self.row: dict[str, Any] = {"tried": 0, "joined": 0, "counted": 0}
        self.row |= {"nearest": np.nan, "error": np.nan}

    def take(self, plan: SearchPlan, chosen: Mapping[str, Any]) -> None:
        """Count a search with the choices that it was made by."""
        row = self.row
        row["tried"] += 1
        if not plan.reached:
            return
        row["joined"] += 1
        error = float(np.linalg.norm(np.array(plan.ends) - self._ends, axis=1).max())
        row["nearest"] = float(np.fmin(row["nearest"], error))
        if plan.searches == self._searches:
            row["counted"] += 1
            if not row["error"] <= error:
                steps = [
                    np.linalg.norm(np.diff(half, axis=0), axis=1) for half in plan.record.paths
                ]
                mean = float(np.mean(steps)) / PRINTED.alpha0
                row |= {"error": error, "mean_step_over_alpha0": mean, **chosen}


FIT = REGISTRY.keeps(
    Study(
        name="qiu_fit",
        title="Declared fit of the master's search to its printed count and meeting points",
        cells=_cells,
        compute=_cell,
        seed=SEED,
        settings={"ratios": list(RATIOS), "radii": list(RADII), "orders": list(ORDERS)},
    )
)


def calibrated_master(kind: type[R]) -> R:
    """The reading that the fit prefers, as far as a kind of reading has its choices."""
    table = FIT.load()
    return reading_of(table.loc[table["error"].idxmin()], kind)


def reading_of(row: pd.Series, kind: type[R]) -> R:
    """The reading with the choices that a row of a study names, as far as its kind has them."""
    found = {str(key): _read(row[key]) for key in row.index if key in kind.names()}
    return kind.nominal(**found)


def _read(value: Any) -> Any:
    """A value of a table as one of the YAML: lists are JSON texts there."""
    if isinstance(value, str):
        return loads(value) if value.startswith("[") else value
    return float(value)
