"""Figure 8 of `qiu` and what is said about the slave's search and both arms together."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, Is, NoOriginal, Result
from .....ledger.assumptions import alternatives
from .....ledger.captions import captions
from .....ledger.printed_values import printed_numbers
from .....planning.checks.contact_check import ARMS, OBSTACLES
from .....planning.search.bidirectional_compiled import plan_bidirectional_compiled
from .....planning.search.splice import smoothed
from .....planning.search.time_map import hull_tracks, replay, shares, time_map
from .....view.diagrams import flow_chart
from ... import ends
from ...calibrated import dual_readings
from ...document import PRINTED
from ...reading import Links, Slave
from ...studies.fit_slave import FIT_SLAVE
from ...studies.free_pairs import FREE

checks = partial(REGISTRY.checks, page="qiu/master_slave")
caption = captions(__file__)
_SHIFTS = (-6, -3, 3, 6)
_STAGES = (
    ("master", "search from both ends", plan_bidirectional_compiled),
    ("master", "join and smooth", smoothed),
    ("moving hull", "poses from both ends to the middle", shares),
    ("moving hull", "circles at the joints, their hulls", hull_tracks),
    ("slave", "search around spheres and hull", plan_bidirectional_compiled),
    ("slave", "join and smooth", smoothed),
    ("slave", "time map of the search", time_map),
    ("slave", "execute both arms by it", replay),
)


@checks(
    "qiu.fig08",
    rules=[
        Is(
            "master_ignores_slave", "another task of the slave leaves the master's path", value=True
        ),
        Is("slave_heeds_master", "another task of the master changes the slave's path", value=True),
        NoOriginal("drawing", "the flow chart"),
    ],
)
def order_of_work(assumed: Assumed) -> Result:
    """The order of work that the code follows, tested by what depends on what."""
    reading = Slave.nominal()
    branches = alternatives("qiu.slave_branch", 0)
    other_branch = next(branch for branch in branches if branch != reading.slave_branch)
    other_radius, _ = alternatives("qiu.goal_radius", 2)
    plan = reading.dual_plan()
    slave_changed = replace(reading, slave_branch=other_branch).dual_plan()
    master_changed = replace(reading, goal_radius=other_radius).dual_plan()
    rows = [
        (part, text, f"{code.__module__.split('.')[-1]}.{code.__name__}")
        for part, text, code in _STAGES
    ]
    return Result(
        obtained={
            "master_ignores_slave": np.array_equal(plan.master_path, slave_changed.master_path),
            "slave_heeds_master": not np.array_equal(plan.slave_path, master_changed.slave_path),
            "stages": [f"{part}: {text}" for part, text, _ in rows],
        },
        table=pd.DataFrame(rows, columns=["part", "step", "code"]),
        caption=caption("fig08"),
        alt="Flow chart in three columns: plan the master, build its moving hull, plan the "
        "slave and execute both arms.",
        figure=lambda: flow_chart(rows),
    )


def _outcomes(assumed: Assumed) -> tuple[dict[str, Any], dict[str, Any]]:
    """How the slave's search came out, at face value and by the calibrated reading."""
    face, other = (plan.slave for plan in dual_readings(Slave.of(assumed)).values())
    printed = PRINTED.slave_meeting, printed_numbers("qiu.claim_slave_counts", *ends.HALVES)
    return ends.outcome(face, *printed), ends.outcome(other, *printed)


@checks("qiu.claim_slave_counts", rules=ends.count_rules("the slave's halves meet"))
def counts(assumed: Assumed) -> Result:
    """Searches of the slave's halves while the hull of the master moves."""
    printed = REGISTRY.printed("qiu.claim_slave_counts")["forward"]
    obtained = ends.counted(*_outcomes(assumed), FIT_SLAVE.load())
    told = caption("claim_slave_counts", printed=printed)
    return Result(obtained, told, witnesses=ends.fit_witness(FIT_SLAVE.load(), np.inf))


@checks("qiu.claim_slave_meet", rules=ends.meeting_rules("the slave's halves meet"))
def meeting(assumed: Assumed) -> Result:
    """Where the slave's halves end, against print."""
    return Result(
        obtained=ends.met(*_outcomes(assumed), PRINTED.slave_meeting),
        caption=caption("claim_slave_meet"),
        witnesses=ends.fit_witness(FIT_SLAVE.load(), ends.near_print("qiu.claim_slave_meet")),
    )


@checks(
    "qiu.claim_master_timeline",
    rules=[
        Is("middle_held", "the middle pose is held in the last searches", value=True),
        Bounded("held_share", "searches with the middle pose, of all", high="last_phase"),
        Bounded("late_step_ratio", "mean step in that phase over the one before", high="smaller"),
    ],
)
def schedule(assumed: Assumed) -> Result:
    """The schedule of master poses over the searches of the slave, and the steps it makes."""
    plan = Slave.of(assumed).dual_plan()
    searches, spread = plan.slave.searches, plan.spread
    held = max(searches - spread, 0)
    share = time_map(plan.slave, spread)
    steps = np.mean(
        [np.linalg.norm(np.diff(half, axis=0), axis=1) for half in plan.slave.record.paths], axis=0
    )
    ratio = float(steps[spread:].mean() / steps[:spread].mean()) if held else None
    return Result(
        obtained={
            "middle_held": held > 0,
            "held_share": held / searches,
            "late_step_ratio": ratio,
            "held_searches": held,
            "wait_samples": len(plan.played()[0]) - len(share),
        },
        table=pd.DataFrame({"sample": range(len(share)), "share_of_master_path": share}),
        caption=caption("claim_master_timeline", searches=searches, samples=len(share)),
    )


@checks(
    "qiu.claim_no_collision",
    rules=[
        Is("joined", "both arms have a path", value=True),
        Bounded("arms", "smallest distance of the links of both arms [m]", low=0.0),
        Bounded(
            "others",
            "smallest distance of a link to a sphere, the table if there is one, or a link of its "
            "own arm [m]",
            low=0.0,
        ),
        Bounded("over_limits", "excess over the joint limits, if they are kept [rad]", high=0.0),
    ],
)
def no_collision(assumed: Assumed) -> Result:
    """Contact of whole links while both arms execute their paths, in step and out of step."""
    reading = Slave.of(assumed)
    plan, scene = reading.dual_plan(), reading.scene(Links.of(assumed).radii)
    found = plan.contact(scene)
    others = [gap for group, gap in found.clearance.items() if group != ARMS]
    shifted = {str(k): plan.contact(scene, shift=k).clearance[ARMS] for k in _SHIFTS}
    return Result(
        obtained={
            "joined": plan.reached,
            "arms": found.clearance[ARMS],
            "others": min(others),
            "over_limits": found.beyond_limits if reading.limits == "kept" else 0.0,
            "obstacles": found.clearance[OBSTACLES],
            "clearance": {**found.clearance, "beyond_limits": found.beyond_limits},
            "out_of_step": shifted,
            "uniform_speed": plan.contact(scene, "uniform").clearance[ARMS],
            "control_points": plan.slave.control_clearance,
        },
        caption=caption("claim_no_collision", most=_SHIFTS[-1]),
        witnesses=_free_witness(),
    )


def _free_witness() -> list[dict[str, Any]]:
    """The reading of the yield map that keeps the largest distance, if any is free."""
    free = FREE.load().query("free")
    if free.empty:
        return []
    index = free["smallest"].idxmax()
    values = {str(key): value for key, value in free.loc[index].items()}
    return [{"choice": f"yield map, cell {index}", "verdict": "holds", "values": values}]
