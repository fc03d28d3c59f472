"""Figure 7 of `xue`: the flow of the whole method, from the transitions that runs take."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np
import pandas as pd

from ...ledger import REGISTRY, Assumed, Is, NoOriginal, Result
from ...planning.plan import Plan
from ...planning.termination import StopReason
from ...tracking import memo
from ...view.transitions import transitions_figure
from .ablation import NAMED
from .layout import placed_slave
from .methods import improved
from .motions import Case, attempt, master_plan, slave_obstacles
from .scenario import SEED
from .trials import starts

checks = partial(REGISTRY.checks, page="xue/planning")

_STATES = {
    "begin": (0.0, 5.0),
    "master: descend the potential": (0.0, 4.0),
    "master: toward the virtual point": (3.4, 4.0),
    "master's path becomes a moving obstacle": (0.0, 3.0),
    "slave: descend the potential": (0.0, 2.0),
    "slave: toward the virtual point": (3.4, 2.0),
    "both paths found": (0.0, 1.0),
    "given up: trapped": (3.4, 0.6),
    "given up: near an obstacle": (1.7, 0.0),
    "given up: step limit": (3.4, 3.0),
}
_END = {
    StopReason.REACHED: "both paths found",
    StopReason.TRAPPED: "given up: trapped",
    StopReason.NEAR_OBSTACLE: "given up: near an obstacle",
    StopReason.STEP_LIMIT: "given up: step limit",
}
_SAME = 1e-9  # [m]
#: Wider perturbations than those of Table 2 [rad], so that every branch is taken.
_WIDTH, _RUNS = 0.6, 40


@checks(
    "xue.fig07",
    rules=[
        Is(
            key="master_first",
            value=True,
            label="the slave's planner meets the finished master path",
        ),
        Is(
            key="unknown_transitions",
            value=0,
            label="transitions between states that are not drawn",
        ),
        NoOriginal(key="chart", label="the content of the chart"),
    ],
)
def flow_chart(assumed: Assumed) -> Result:
    """States and transitions of the planner, counted over runs from widely perturbed starts."""
    case = Case.of(assumed)
    layouts = (
        case.layout,
        replace(case.layout, **NAMED["yawed"]),
        replace(case.layout, window_opening_width=0.4, window_opening_height=0.35),
    )
    counts = sum((_transitions(case._replace(layout=layout)) for layout in layouts), Counter())
    unknown = [pair for pair in counts if not set(pair) <= set(_STATES)]
    return Result(
        obtained={
            "master_first": _master_first(case),
            "transitions": len(counts),
            "unknown_transitions": len(unknown),
        },
        table=pd.DataFrame([{"from": a, "to": b, "taken": n} for (a, b), n in counts.items()]),
        caption=(
            f"The flow that {_RUNS} runs of the code took, each arrow with how often: the master "
            "is planned first, its path becomes a moving obstacle, then the slave is planned; "
            "either turns to the virtual point when it stands still. The content of the printed "
            "chart is not in the text edition, so it cannot be compared."
        ),
        alt="Flow chart: master, then slave, each with a side branch to the virtual point.",
        figure=lambda: transitions_figure(_shown(counts), counts),
    )


def _master_first(case: Case) -> bool:
    """Whether the moving obstacles of the slave follow the finished path of the master."""
    obstacles, plan = slave_obstacles(case), master_plan(case.layout, case.method)
    if obstacles is None:
        return False
    last = obstacles.cores[:, -1, 0]
    follows = np.abs(last[:, np.newaxis] - plan.tcp).max(axis=2).min(axis=1)
    return bool(len(obstacles.cores) > 1 and follows.max() < _SAME)


@memo(512)
def _transitions(case: Case) -> Counter[tuple[str, str]]:
    """Transitions of whole runs: master, hand-over, slave."""
    counts: Counter[tuple[str, str]] = Counter()
    slave = placed_slave(case.layout)
    plan = master_plan(case.layout, case.method)
    obstacles = slave_obstacles(case)
    if plan is None or obstacles is None:
        return counts
    settings = improved(case.method, case.layout.window_centre, slave.goal)
    for start in starts(case, _WIDTH, _RUNS, np.random.default_rng(SEED)):
        made = attempt(slave, start, obstacles, settings)
        route = ["begin", *_route("master", plan)]
        if made is not None:
            route += ["master's path becomes a moving obstacle", *_route("slave", made)]
            route.append(_END[made.reason])
        counts.update(pairwise(route))
    return counts


def _route(name: str, plan: Plan) -> list[str]:
    """States of one plan in order."""
    states = (f"{name}: descend the potential", f"{name}: toward the virtual point")
    changes = np.flatnonzero(np.diff(plan.active))
    return [states[0], *(states[int(plan.active[k + 1])] for k in changes)]


def _shown(counts: Counter[tuple[str, str]]) -> dict[str, tuple[float, float]]:
    used = {name for pair in counts for name in pair}
    return {name: place for name, place in _STATES.items() if name in used}
