"""Stored study of `qiu`: a declared fit of the slave's search to what is printed of it.

As :mod:`.fit`, around the hull of the master as it was fitted there.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import alternatives, hashable
from ....ledger.printed_values import printed_numbers
from ....planning.field.hull_obstacle import HullTrack
from ....planning.search.bidirectional_compiled import plan_bidirectional_compiled
from ....planning.search.time_map import hull_tracks
from ....planning.tasks.elbow_branches import BRANCHES
from ....tracking import memo
from ..document import PRINTED, SEED, placed
from ..reading import CONTROL_POINTS, Improved, Slave
from .fit import ORDERS, Tally, calibrated_master, combinations, reading_of, wrists

RATIOS = tuple(float(f"{x:.2e}") for x in np.geomspace(1e-5, 1.0, 21))
CHOSEN = ("update_order", "gain_ratio")


def _cells() -> list[dict[str, Any]]:
    return combinations(
        slave_branch=BRANCHES,
        slave_wrist=wrists("slave_wrist"),
        control_points=list(CONTROL_POINTS),
        adaptive_step=alternatives("qiu.adaptive_step", 0),
    )


@memo()
def _hulls() -> tuple[HullTrack, HullTrack]:
    """Hulls of the calibrated master that the halves of the slave meet."""
    reading, plan = Slave.nominal(), calibrated_master(Improved).plan()
    spread = round(reading.schedule_steps)
    return hull_tracks(plan.placed, reading.smooth(plan.path), reading.circles(), spread)


def _cell(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    printed = printed_numbers("qiu.claim_slave_counts", "forward", "backward")
    tally = Tally(PRINTED.slave_meeting, int(printed[0]))
    base = Slave.nominal(**{key: hashable(value) for key, value in cell.items()})
    arm, goal, hulls = placed("slave"), base.slave_posture(), _hulls()
    for order, ratio in product(ORDERS, RATIOS):
        reading = replace(base, update_order=order, gain_ratio=ratio)
        settings, around = reading.settings(goal=goal), reading.obstacles()
        plan = plan_bidirectional_compiled(arm, PRINTED.start, goal, around, settings, hulls)
        tally.take(plan, {key: getattr(reading, key) for key in CHOSEN})
    return tally.row


FIT_SLAVE = REGISTRY.keeps(
    Study(
        name="qiu_fit_slave",
        title="Declared fit of the slave's search to its printed count and meeting points",
        cells=_cells,
        compute=_cell,
        seed=SEED + 1,
        settings={"ratios": list(RATIOS), "orders": list(ORDERS)},
    )
)


def calibrated_slave() -> Slave:
    """The reading of the slave that the fit prefers."""
    table = FIT_SLAVE.load()
    return reading_of(table.loc[table["error"].idxmin()], Slave)
