"""Where the motions of `xue` end: at potential zero, or where the gradient vanishes."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...ledger import REGISTRY, Assumed, Bounded, Residual, Result, Role
from ...planning.descent.problem import problem
from ...planning.descent.termination import StopReason
from ...tracking import memo
from .chosen import assumption, nominal
from .layout import placed_slave
from .methods import POSITION_TOLERANCE
from .motions import Case, slave_obstacles
from .printed_field import attraction
from .trap_counts import text_counts
from .trials import METHODS, TRIALS, run_trials, starts

checks = partial(REGISTRY.checks, page="xue/table2")


@checks(
    "xue.claim_stop_zero",
    rules=[
        Residual("at_goal", "potential at a goal out of every obstacle's range", high=1e-9),
        Bounded(
            "printed_traps",
            "runs that stand still in a local minimum, by the document itself",
            low=1,
            role=Role.CONTRADICTS,
        ),
        Bounded(
            "off_goal",
            "attraction, by (9) as printed, as near to the goal as no trap is",
            low=1e-9,
            role=Role.CONTRADICTS,
        ),
    ],
)
def stops_at_zero(assumed: Assumed) -> Result:
    """The potential where runs end: at the goal and in a trap."""
    names = ("classical_method", "trial_perturbation", "trial_seed")
    at_goal, at_trap, gradient = _trap(nominal(), *(assumption(name) for name in names))
    near = attraction(np.zeros(3), np.array([POSITION_TOLERANCE, 0.0, 0.0]))
    traps = max(text_counts().values())
    shown = "no run is trapped" if at_trap is None else (
        f"a trapped run stands still at a potential of {at_trap:.2f}, where the gradient is "
        f"{gradient:.0e}"
    )  # fmt: skip
    return Result(
        obtained={
            "printed_traps": traps,
            "off_goal": near,
            "at_goal": at_goal,
            "at_trap": at_trap,
            "gradient": gradient,
        },
        caption=(
            f"At the slave's goal the total potential is {at_goal:.1e}. Yet {traps} of the printed "
            "runs stand still away from it, where (9) alone is positive: at least "
            f"{near:.1e} beyond the distance of {POSITION_TOLERANCE:g} m at which a run arrives. "
            f"In the arrangement shown {shown}. What ends a motion is a vanishing gradient, as the "
            "document itself says of its local minima, not potential 0."
        ),
    )


@memo()
def _trap(
    case: Case, reading: str, half_width: float, seed: int
) -> tuple[float, float | None, float | None]:
    """U at the goal, and U and |dU/dq| at the first trap among the trials."""
    placed, obstacles = placed_slave(case.layout), slave_obstacles(case)
    method = "five_points" if reading == "five_points" else "traditional"
    settings = METHODS[method].settings(case)
    begin = starts(case, half_width, TRIALS, np.random.default_rng(seed))
    made = problem(placed, placed.start, placed.goal, obstacles, settings)
    runs = run_trials(case, method, begin)
    rest = len(obstacles.cores) - 1
    at_goal = float(made.field.value(placed.goal, rest))
    stuck = np.flatnonzero(runs.reason == StopReason.TRAPPED)
    if not len(stuck):
        return at_goal, None, None
    first = stuck[runs.gradient[stuck].argmin()]
    return at_goal, float(made.field.value(runs.last[first], rest)), float(runs.gradient[first])
