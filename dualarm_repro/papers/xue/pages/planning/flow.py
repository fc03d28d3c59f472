"""Figure 7 of `xue`: the flow of the whole method, from the transitions that runs take."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Is, NoOriginal, Result
from .....ledger.captions import captions
from .....planning.descent.termination import StopReason
from .....planning.plan import Plan
from .....planning.trials.runs import attempt
from .....planning.trials.turns import onsets, stands_still
from .....tracking import memo
from .....view.decisions import Node, Way, above, below, decisions_figure, left_of, right_of
from ...document import SEED
from ...motions import master_plan, present, slave_obstacles, slave_task
from ...outcomes import VARIANTS, starts
from ...reading import BLOCK, Case, PlannerChoice, improved, nominal
from ...studies.ablation import NAMED

checks = partial(REGISTRY.checks, page="xue/planning")
caption = captions(__file__)

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
            "ways": (taken := ways_taken(runs)),
        },
        table=pd.DataFrame([{"way": name, "taken": count} for name, count in taken.items()]),
        caption=caption("fig07", still=still),
        alt="Flow chart: for the master, then for the slave, a step is repeated until the arm has "
        "arrived; where it stands still, the virtual point acts, or the arm is given up.",
        figure=lambda: chart(cases[0].planner, taken),
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


def ways_taken(runs: Sequence[tuple[Plan, ...]]) -> dict[str, int]:
    """How often runs took each way of the chart: steps of both arms, arrivals, turns to the virtual
    point, arms given up in a trap or at the limit of steps, and slaves whose master has arrived."""
    plans = [plan for run in runs for plan in run]
    reasons = Counter(plan.reason for plan in plans)
    return {
        "steps": sum(plan.steps for plan in plans),
        "arrived": reasons[StopReason.REACHED],
        "to_virtual_point": sum(len(onsets(plan)) for plan in plans),
        "given_up": len(plans) - reasons[StopReason.REACHED] - reasons[StopReason.STEP_LIMIT],
        "out_of_steps": reasons[StopReason.STEP_LIMIT],
        "slaves": sum(len(run) == 2 for run in runs),
        "both": sum(len(run) == 2 and run[1].reached for run in runs),
    }


def chart(planner: PlannerChoice, taken: Mapping[str, int]) -> Any:
    """The flow as it is run, with its criteria, and at every way how often it was taken."""
    end = improved(planner, np.zeros(3), np.zeros(6))
    point = present(end.virtual_point, "virtual point")
    tries, most, near = point.max_activations, point.max_steps, point.release_distance
    nodes = {
        "master": Node("Master first: only the window is an obstacle", 1, 0),
        "slave": Node("Slave: the master's path is a moving obstacle", 2, 0),
        "step": Node("One step down the gradient of the total potential (16)", 0, 1.5),
        "arrived": Node(
            f"Every joint within {planner.goal_tolerance:g} rad of its goal?", 1, 1, True
        ),
        "last": Node("Was it the slave?", 2, 1, True),
        "still": Node(
            f"Means of two blocks of {BLOCK} steps within {planner.stuck_threshold:g} rad?",
            1, 2, True,
        ),
        "both": Node("Both paths are found", 2, 2, end=True),
        "tries": Node(f"Virtual point tried fewer than {tries} times?", 1, 3, True),
        "given_up": Node(f"Given up: trapped, or {planner.step_limit:g} steps are over", 2, 3,
                         end=True),
        "virtual": Node(
            f"Virtual point acts until {near:g} m from it, or for {most} steps", 0, 3
        ),
    }  # fmt: skip
    n, stuck = nodes, taken["to_virtual_point"] + taken["given_up"]
    return decisions_figure(nodes, [
        Way([below(n["master"]), above(n["arrived"])]),
        Way([right_of(n["arrived"]), left_of(n["last"])], f"yes {taken['arrived']}"),
        Way([above(n["last"]), below(n["slave"])], f"no {taken['slaves']}"),
        Way([left_of(n["slave"]), (1.5, 0.0), (1.5, 0.5), (1.0, 0.5)]),
        Way([below(n["last"]), above(n["both"])], f"yes {taken['both']}"),
        Way([below(n["arrived"]), above(n["still"])], "no"),
        Way([left_of(n["still"]), (0.0, 2.0), below(n["step"])], "no"),
        Way([above(n["step"]), (0.0, 1.0), left_of(n["arrived"])], f"{taken['steps']} steps", 1),
        Way([below(n["still"]), above(n["tries"])], f"yes {stuck}"),
        Way([left_of(n["tries"]), right_of(n["virtual"])], f"yes {taken['to_virtual_point']}"),
        Way([above(n["virtual"]), (0.0, 2.2), below(n["step"])]),
        Way([right_of(n["tries"]), left_of(n["given_up"])], f"no {taken['given_up']}"),
    ])  # fmt: skip
