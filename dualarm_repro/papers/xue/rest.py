"""Where the motions of `xue` end: at potential zero, or where the gradient vanishes."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...errors import InputError
from ...ledger import REGISTRY, Assumed, Bounded, Result, Role
from ...planning.problem import problem
from ...planning.termination import StopReason
from ...tracking import memo
from .layout import placed_slave
from .motions import Case, slave_obstacles
from .trap_counts import text_counts
from .trials import METHODS, TRIALS, run_trials, starts

checks = partial(REGISTRY.checks, page="xue/table2")

NOTHING = "In this arrangement there is nothing to plan."


@checks(
    "xue.claim_stop_zero",
    rules=[
        Bounded(
            key="at_goal", high=1e-9, label="potential at a goal out of every obstacle's range"
        ),
        Bounded(
            key="printed_traps",
            low=1,
            role=Role.CONTRADICTS,
            label="runs that stand still in a local minimum, by the document itself",
        ),
        Bounded(
            key="at_trap",
            low="above_zero",
            role=Role.CONTRADICTS,
            label="potential where a run stands still, in what the document calls a local minimum",
        ),
        Bounded(key="gradient", high="flat", role=Role.CONTRADICTS, label="gradient at that place"),
    ],
    samples=16,
)
def stops_at_zero(assumed: Assumed) -> Result:
    """The potential where runs end: at the goal and in a trap."""
    case = Case.of(assumed)
    names = ("classical_method", "trial_perturbation", "trial_seed")
    ends = _trap(case, *(assumed[name] for name in names))
    printed = {"printed_traps": max(text_counts().values())}
    if ends is None:
        nothing = dict.fromkeys(("at_goal", "at_trap", "gradient"))
        return Result({**nothing, **printed}, NOTHING)
    at_goal, at_trap, gradient = ends
    trap = "no run is trapped." if at_trap is None else (
        f"a trapped run stands still at a potential of {at_trap:.2f}, where the gradient is "
        f"{gradient:.0e}."
    )  # fmt: skip
    return Result(
        obtained={"at_goal": at_goal, "at_trap": at_trap, "gradient": gradient, **printed},
        caption=(
            f"At the slave's goal the total potential is {at_goal:.1e}; {trap} What ends a motion "
            "is a vanishing gradient, as the document itself says of its local minima, not "
            "potential 0."
        ),
    )


@memo(512)
def _trap(
    case: Case, reading: str, half_width: float, seed: int
) -> tuple[float, float | None, float | None] | None:
    """U at the goal, and U and |dU/dq| at the first trap among the trials."""
    placed, obstacles = placed_slave(case.layout), slave_obstacles(case)
    if obstacles is None:
        return None
    method = "five_points" if reading == "five_points" else "traditional"
    settings = METHODS[method].settings(case)
    begin = starts(case, half_width, TRIALS, np.random.default_rng(seed))
    try:
        made = problem(placed, placed.start, placed.goal, obstacles, settings)
    except InputError:  # the unperturbed start touches an obstacle
        return None
    runs = run_trials(case, method, begin)
    rest = len(obstacles.cores) - 1
    at_goal = float(made.field.value(placed.goal, rest))
    stuck = np.flatnonzero(runs.reason == StopReason.TRAPPED)
    if not len(stuck):
        return at_goal, None, None
    first = stuck[runs.gradient[stuck].argmin()]
    return at_goal, float(made.field.value(runs.last[first], rest)), float(runs.gradient[first])
