"""Figure 7 of `xue`: the flow of the whole method, from the transitions that runs take."""

from __future__ import annotations

from collections import Counter
from functools import partial
from itertools import pairwise

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Is, NoOriginal, Result
from .....ledger.captions import captions
from .....planning.descent.termination import StopReason
from .....planning.plan import Plan
from .....planning.trials.runs import attempt
from .....planning.trials.turns import onsets, phases, stands_still
from .....tracking import memo
from .....view.transitions import transitions_figure
from ...document import SEED
from ...motions import master_plan, slave_obstacles, slave_task
from ...outcomes import VARIANTS, starts
from ...reading import BLOCK, Case, nominal
from ...studies.ablation import NAMED

checks = partial(REGISTRY.checks, page="xue/planning")
caption = captions(__file__)

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
_WIDTH, _RUNS = 0.6, 12


@checks(
    "xue.fig07",
    rules=[
        Is("master_first", "the slave's planner meets the finished master path", value=True),
        Is(
            "only_when_still",
            "an arm turns to the virtual point only where it stands still",
            value=True,
        ),
        Is("arrives_without", "no run arrives while the virtual point acts", value=True),
        NoOriginal("chart", "the content of the chart"),
    ],
)
def flow_chart(assumed: Assumed) -> Result:
    """States and transitions of the planner, counted over runs from widely perturbed starts."""
    windows = (*NAMED.values(), {"window_opening_width": 0.4, "window_opening_height": 0.35})
    switching = assumed["virtual_switching"]
    cases = [nominal(virtual_switching=switching, **window) for window in windows]
    runs = [run for case in cases for run in _runs(case)]
    counts = Counter(pair for run in runs for pair in pairwise(_states_of(run)))
    plans = [plan for run in runs for plan in run]
    switched = [(plan, k) for plan in plans for k in onsets(plan)]
    arrived = [plan for plan in plans if plan.reached]
    threshold = cases[0].planner.stuck_threshold
    still = sum(stands_still(plan, k, BLOCK, threshold) for plan, k in switched)
    return Result(
        obtained={
            "master_first": _master_first(cases[0]),
            "only_when_still": still == len(switched),
            "arrives_without": not any(plan.active[-1] for plan in arrived),
            "runs": len(runs),
            "switched_on": len(switched),
            "transitions": len(counts),
        },
        table=pd.DataFrame([{"from": a, "to": b, "taken": n} for (a, b), n in counts.items()]),
        caption=caption("fig07", still=still),
        alt="Flow chart: master, then slave, each with a side branch to the virtual point.",
        figure=lambda: transitions_figure(_shown(counts), counts),
    )


def _master_first(case: Case) -> bool:
    """Whether the moving obstacles of the slave follow the finished path of the master."""
    obstacles, plan = slave_obstacles(case), master_plan(case.layout, case.planner)
    if obstacles is None or plan is None:
        return False
    last = obstacles.cores[:, -1, 0]
    follows = np.abs(last[:, np.newaxis] - plan.tcp).max(axis=2).min(axis=1)
    return bool(len(obstacles.cores) > 1 and follows.max() < _SAME)


@memo(64)
def _runs(case: Case) -> tuple[tuple[Plan, ...], ...]:
    """Whole runs from widely perturbed starts: the plan of the master, then that of the slave."""
    plan = master_plan(case.layout, case.planner)
    if plan is None or slave_obstacles(case) is None:
        return ()
    (slave, obstacles), settings = slave_task(case), VARIANTS["improved"].settings(case)
    begin = starts(case, _WIDTH, _RUNS, np.random.default_rng(SEED))
    found = (attempt(slave, start, obstacles, settings) for start in begin)
    return tuple((plan, own) if own is not None else (plan,) for own in found)


def _states_of(run: tuple[Plan, ...]) -> list[str]:
    """States of a whole run in order: master, hand-over, slave."""
    route = ["begin", *_route("master", run[0])]
    if len(run) == 2:
        route += ["master's path becomes a moving obstacle", *_route("slave", run[1])]
        route.append(_END[StopReason(run[1].reason)])
    return route


def _route(name: str, plan: Plan) -> list[str]:
    """States of one plan in order."""
    states = (f"{name}: descend the potential", f"{name}: toward the virtual point")
    return [states[acts] for acts in phases(plan)]


def _shown(counts: Counter[tuple[str, str]]) -> dict[str, tuple[float, float]]:
    used = {name for pair in counts for name in pair}
    return {name: place for name, place in _STATES.items() if name in used}
