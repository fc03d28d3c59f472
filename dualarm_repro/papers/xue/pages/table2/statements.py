"""What else `xue` says of its method: times, where a motion ends, no inverse kinematics."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from time import perf_counter

import numpy as np

from .....arms.counted_inverse import counting_inverse
from .....arms.tool_postures import ToolRule, tool_posture
from .....ledger import REGISTRY, Assumed, Bounded, Is, Residual, Result, Role
from .....ledger.captions import captions
from .....ledger.formula import parse
from .....planning.descent.apf import plan_apf
from .....planning.descent.batch import plan_batch
from .....planning.descent.termination import StopReason
from .....tracking import memo
from ...document import (
    METHODS_OF_TABLE_2,
    Posed,
    assumptions,
    placed_master,
    printed_vector,
    text_counts,
)
from ...motions import present, slave_task, window_obstacles
from ...outcomes import TRIALS, VARIANTS, run_variant, starts, variant_of
from ...reading import POSITION_TOLERANCE, Case, improved, nominal
from ..potentials.printed_field import attraction
from .table import TRIAL_SETTINGS, Trials, assumed_trials

checks = partial(REGISTRY.checks, page="xue/table2")
caption = captions(__file__)

_REPEATS = 3  # of a measured time
#: Printed start and goal of each arm: angles under ``q`` or a position under ``position``.
_ENDS = {
    "master": ("claim_master_start", "claim_master_goal"),
    "slave": ("claim_slave_start", "claim_slave_end"),
}


@checks(
    "xue.claim_times",
    rules=[
        Bounded(
            "step_ratio",
            "steps of the method with the longer printed time over those of the other",
            low=1,
        )
    ],
    samples=32,
)
def times(assumed: Assumed) -> Result:
    """Steps of both methods, which do not depend on the machine, and times measured here."""
    trials, timed = assumed_trials(assumed), assumed["timed_runs"]
    printed = printed_seconds(assumed["table2_exchange"])
    longer, shorter = sorted(printed, key=lambda name: printed[name], reverse=True)
    steps = _steps(trials, timed)
    many, few = steps[longer], steps[shorter]
    return Result(
        obtained={
            "mean_steps": steps,
            "step_ratio": many / few if many and few else None,
            "printed_ratio": printed[longer] / printed[shorter],
            "longer": longer,
        },
        measured={} if trials is None else _milliseconds(Case.of(assumed), assumed),
        caption=caption("claim_times", timed=timed),
    )


def printed_seconds(exchange: str) -> dict[str, float]:
    """The printed mean times by method; with the rows exchanged if only their labels are wrong."""
    printed = REGISTRY.printed("xue.claim_times")
    names = METHODS_OF_TABLE_2 if exchange == "trap_column" else METHODS_OF_TABLE_2[::-1]
    return {name: float(printed[row]) for name, row in zip(names, METHODS_OF_TABLE_2, strict=True)}


def _steps(trials: Trials | None, timed: str) -> dict[str, float | None]:
    """Mean steps per method; None where there is no run to take them of."""
    field = "steps_reached" if timed == "successful" else "steps_all"
    if trials is None:
        return dict.fromkeys(METHODS_OF_TABLE_2)
    found = {name: getattr(one, field) for name, one in trials._asdict().items()}
    return {name: None if np.isnan(steps) else steps for name, steps in found.items()}


def _milliseconds(case: Case, assumed: Assumed) -> dict[str, float]:
    """Mean time per run, planning only, best of some repeats [ms]."""
    placed, obstacles = slave_task(case)
    rng = np.random.default_rng(assumed["trial_seed"])
    begin = starts(case, assumed["trial_perturbation"], TRIALS, rng)
    found = {}
    for name in METHODS_OF_TABLE_2:
        settings, best = VARIANTS[name].settings(case), np.inf
        for _ in range(_REPEATS):
            since = perf_counter()
            plan_batch(placed, begin, placed.goal, obstacles, settings)
            best = min(best, perf_counter() - since)
        found[f"ms_per_run_{name}"] = 1e3 * best / TRIALS
    return found


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
    at_goal, at_trap, gradient = _trap(nominal(), *assumptions(*TRIAL_SETTINGS).values())
    return Result(
        obtained={
            "printed_traps": max(text_counts().values()),
            "off_goal": attraction(np.zeros(3), np.array([POSITION_TOLERANCE, 0.0, 0.0])),
            "at_goal": at_goal,
            "at_trap": at_trap,
            "gradient": gradient,
        },
        caption=caption("claim_stop_zero", tolerance=POSITION_TOLERANCE),
    )


@memo()
def _trap(
    case: Case, reading: str, half_width: float, seed: int
) -> tuple[float, float | None, float | None]:
    """U at the goal, and U and |dU/dq| at the first trap among the trials."""
    made, name = VARIANTS[variant_of(reading)].problem(case), variant_of(reading)
    runs = run_variant(case, name, starts(case, half_width, TRIALS, np.random.default_rng(seed)))
    rest = len(made.obstacles.cores) - 1
    at_goal = float(made.field.value(made.goal, rest))
    stuck = np.flatnonzero(runs.reason == StopReason.TRAPPED)
    if not len(stuck):
        return at_goal, None, None
    first = stuck[runs.gradient[stuck].argmin()]
    return at_goal, float(made.field.value(runs.last[first], rest)), float(runs.gradient[first])


@checks(
    "xue.claim_no_ik",
    rules=[
        Is("calls.master", "calls in the run of the master from what is printed", value=0),
        Is(
            "needs_goal_angles",
            "(13), as printed, needs the goal angles",
            value=True,
            role=Role.CONTRADICTS,
        ),
        Bounded(
            "calls.slave",
            "calls in the run of the slave from what is printed",
            low=1,
            role=Role.CONTRADICTS,
        ),
    ],
)
def without_inverse_kinematics(assumed: Assumed) -> Result:
    """Calls of the closed-form inverse in whole runs, from the printed start and goal on."""
    case = nominal()
    around = {
        "master": (placed_master(case.layout), window_obstacles(case.layout)),
        "slave": slave_task(case),
    }
    calls, steps = {}, {}
    for name, (arm, obstacles) in around.items():
        inner, counter = counting_inverse(arm.arm)
        counted = replace(arm, arm=inner)
        start, goal = (_angles(counted, item, case.layout.slave_postures) for item in _ENDS[name])
        settings = improved(case.planner, case.layout.window_centre, goal)
        plan = plan_apf(counted, start, goal, obstacles, settings)
        calls[name], steps[name] = len(counter), plan.steps
    return Result(
        obtained={"calls": calls, "steps": steps, "needs_goal_angles": needs_goal_angles()},
        caption=caption("claim_no_ik"),
    )


def needs_goal_angles() -> bool:
    """Whether the right side of (13) holds the angles of the goal."""
    formula = parse(REGISTRY.printed("xue.eq13")["formula"])
    return any(str(symbol).startswith("theta_g") for symbol in formula.sides[-1].free_symbols)


def _angles(placed: Posed, item: str, rule: ToolRule) -> np.ndarray:
    """Angles of a printed start or goal; a printed position takes inverse kinematics."""
    if "q" in REGISTRY.printed(f"xue.{item}"):
        return printed_vector(item, "q")
    target = printed_vector(item, "position")
    return present(tool_posture(placed.arm, target - placed.placement.translation, rule), item)
