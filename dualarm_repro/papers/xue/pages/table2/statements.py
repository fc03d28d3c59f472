"""What else `xue` says of its method: times, where a motion ends, no inverse kinematics."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from time import perf_counter

import numpy as np

from .....arms.counted_inverse import counting_inverse
from .....arms.tool_postures import ToolRule, tool_posture
from .....ledger import REGISTRY, Assumed, Bounded, Exceeds, Is, Residual, Result, Role
from .....ledger.captions import captions
from .....ledger.formula import parse
from .....planning.descent.apf import plan_apf
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
from ...outcomes import READINGS, TRIALS, VARIANTS, run_variant, starts, variant_of
from ...reading import POSITION_TOLERANCE, Case, improved, nominal
from ...stored import lottery_table, missed_share
from ..potentials.printed_field import attraction
from .table import TRIAL_SETTINGS, Trials, assumed_trials, trials_of

checks = partial(REGISTRY.checks, page="xue/table2")
caption = captions(__file__)

_REPEATS = 3  # of a measured time
_TIMED = ("successful", "all")
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
            "by_reading": _ratios_by_reading(assumed, longer, shorter),
            "printed_ratio": printed[longer] / printed[shorter],
            "longer": longer,
        },
        measured={} if trials is None else _milliseconds(Case.of(assumed), assumed),
        caption=caption("claim_times", timed=timed),
    )


def _ratios_by_reading(
    assumed: Assumed, longer: str, shorter: str
) -> dict[str, dict[str, float | None]]:
    """The same ratio under every reading of the traditional method, over either sort of runs."""
    found: dict[str, dict[str, float | None]] = {}
    for reading in READINGS:
        trials = trials_of(
            Case.of(assumed), reading, *(assumed[name] for name in TRIAL_SETTINGS[1:])
        )
        found[reading] = {}
        for timed in _TIMED:
            steps = _steps(trials, timed)
            many, few = steps[longer], steps[shorter]
            found[reading][timed] = many / few if many and few else None
    return found


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
            VARIANTS[name].batch(placed, begin, placed.goal, obstacles, settings)
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
    case: Case, reading: str, criterion: str, half_width: float, seed: int
) -> tuple[float, float | None, float | None]:
    """U at the goal, and U and |dU/dq| at the first trap among the trials."""
    made, name = VARIANTS[variant_of(reading)].problem(case), variant_of(reading)
    begin = starts(case, half_width, TRIALS, np.random.default_rng(seed))
    runs = run_variant(case, name, begin, criterion)
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
        Is("calls.master", "poses solved in the run of the master by (13)", value=0),
        Exceeds(
            "missed",
            "mean share of an arrangement's runs that miss by a point in Cartesian space",
            threshold="hard",
        ),
    ],
)
def without_inverse_kinematics(assumed: Assumed) -> Result:
    """A point in Cartesian space that the arm follows, against angles, over the lottery."""
    calls, steps = _counted_calls()
    table = lottery_table()
    missed, runs, trapped = (
        int(table[f"cartesian_ik_{name}"].sum()) for name in ("missed", "runs", "trapped")
    )
    return Result(
        obtained={
            "calls": calls,
            "steps": steps,
            "needs_goal_angles": needs_goal_angles(),
            "missed": missed_share("cartesian_ik")._asdict(),
            "runs_missed": {"count": missed, "of": runs},
            "without_posture_or_colliding": missed - trapped,
            "improved_missed": missed_share("improved")._asdict(),
            "arrangements": len(table),
        },
        caption=caption("claim_no_ik"),
    )


def _counted_calls() -> tuple[dict[str, int], dict[str, int]]:
    """Calls of the closed-form inverse and steps in whole runs by (13), by arm."""
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
    return calls, steps


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
