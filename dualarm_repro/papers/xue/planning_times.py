"""The mean times of Table 2 of `xue`: their order, by steps that are counted."""

from __future__ import annotations

from functools import partial
from time import perf_counter

import numpy as np

from ...ledger import REGISTRY, Assumed, Bounded, Result
from ...planning.descent.batch import plan_batch
from .layout import placed_slave
from .motions import Case, slave_obstacles
from .table_2 import Trials, assumed_trials
from .trap_counts import METHODS_OF_TABLE_2
from .trials import METHODS, TRIALS, starts

checks = partial(REGISTRY.checks, page="xue/table2")

_REPEATS = 3


@checks(
    "xue.claim_times",
    rules=[
        Bounded(
            "step_ratio",
            "steps of the method with the longer printed time over those of the other",
            low=1,
        ),
    ],
    samples=32,
)
def times(assumed: Assumed) -> Result:
    """Steps of both methods, which do not depend on the machine, and times measured here."""
    trials, timed = assumed_trials(assumed), assumed["timed_runs"]
    printed = printed_seconds(assumed["table2_exchange"])
    longer, shorter = sorted(printed, key=printed.get, reverse=True)
    steps = _steps(trials, timed)
    ratio = None if not (steps[longer] and steps[shorter]) else steps[longer] / steps[shorter]
    return Result(
        obtained={
            "mean_steps": steps,
            "step_ratio": ratio,
            "printed_ratio": printed[longer] / printed[shorter],
            "longer": longer,
        },
        measured={} if trials is None else _milliseconds(Case.of(assumed), assumed),
        caption=(
            f"With the labels read so that the {longer} method takes the longer, the printed times "
            f"have a ratio of {printed[longer] / printed[shorter]:.2f}. Over {timed} runs the "
            f"traditional method makes {_number(steps['traditional'])} steps on average and the "
            f"improved one {_number(steps['improved'])}. Seconds depend on a computer that is not "
            "named; the steps, which can be counted, carry the order. A run that ends in a trap "
            "adds the steps of the trap detection, so that the order also follows from what is "
            "counted as a planning time."
        ),
    )


def printed_seconds(exchange: str) -> dict[str, float]:
    """The printed mean times by method; with the rows exchanged if only their labels are wrong."""
    printed = REGISTRY.printed("xue.claim_times")
    names = METHODS_OF_TABLE_2 if exchange == "trap_column" else METHODS_OF_TABLE_2[::-1]
    return {name: float(printed[row]) for name, row in zip(names, METHODS_OF_TABLE_2, strict=True)}


def _steps(trials: Trials | None, timed: str) -> dict[str, float | None]:
    field = "steps_reached" if timed == "successful" else "steps_all"
    return {
        name: None
        if trials is None or np.isnan(getattr(getattr(trials, name), field))
        else getattr(getattr(trials, name), field)
        for name in METHODS_OF_TABLE_2
    }


def _milliseconds(case: Case, assumed: Assumed) -> dict[str, float]:
    """Mean time per run, planning only, best of some repeats [ms]."""
    placed, obstacles = placed_slave(case.layout), slave_obstacles(case)
    rng = np.random.default_rng(assumed["trial_seed"])
    begin = starts(case, assumed["trial_perturbation"], TRIALS, rng)
    found = {}
    for name in METHODS_OF_TABLE_2:
        settings, best = METHODS[name].settings(case), np.inf
        for _ in range(_REPEATS):
            since = perf_counter()
            plan_batch(placed, begin, placed.goal, obstacles, settings)
            best = min(best, perf_counter() - since)
        found[f"ms_per_run_{name}"] = 1e3 * best / TRIALS
    return found


def _number(value: float | None) -> str:
    return "no" if value is None else f"{value:.0f}"
