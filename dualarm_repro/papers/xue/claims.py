"""Further statements of `xue` on the method: when it stops, inverse kinematics, superiority."""

from __future__ import annotations

import copy
from functools import partial

import numpy as np
import pandas as pd

from ...errors import InputError
from ...ledger import REGISTRY, Assumed, Bounded, Is, Result, Role
from ...planning.apf import plan_apf
from ...planning.problem import problem
from ...planning.termination import StopReason
from ...scene import PlacedArm
from ...tracking import memo
from .layout import placed_slave
from .methods import improved, traditional
from .motions import Case, slave_obstacles, slave_plan
from .postures import posture
from .stored import lottery_table, missed
from .trials import FLAT, METHODS, TRIALS, run_trials, starts

checks = partial(REGISTRY.checks, page="xue/table2")

NOTHING = "In this arrangement there is nothing to plan."


@checks(
    "xue.claim_stop_zero",
    rules=[
        Bounded(
            key="at_goal", high=1e-9, label="potential at a goal out of every obstacle's range"
        ),
        Bounded(
            key="at_trap",
            low=0.01,
            role=Role.CONTRADICTS,
            label="potential where a run stands still, in what the document calls a local minimum",
        ),
        Bounded(key="gradient", high=FLAT, role=Role.CONTRADICTS, label="gradient at that place"),
    ],
    samples=16,
)
def stops_at_zero(assumed: Assumed) -> Result:
    """The potential where runs end: at the goal and in a trap."""
    case = Case.of(assumed)
    names = ("classical_method", "trial_perturbation", "trial_seed")
    ends = _trap(case, *(assumed[name] for name in names))
    if ends is None:
        return Result({"at_goal": None, "at_trap": None, "gradient": None}, NOTHING)
    at_goal, at_trap, gradient = ends
    trap = "no run is trapped." if at_trap is None else (
        f"a trapped run stands still at a potential of {at_trap:.2f}, where the gradient is "
        f"{gradient:.0e}."
    )  # fmt: skip
    return Result(
        obtained={"at_goal": at_goal, "at_trap": at_trap, "gradient": gradient},
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


@checks(
    "xue.claim_no_ik",
    rules=[
        Is(
            key="improved_plan", value=0, label="calls of inverse kinematics while (13)-(16) is run"
        ),
        Bounded(key="postures", low=1, label="calls for the goal angles that (13) needs"),
        Bounded(
            key="traditional_plan",
            low=1,
            label="calls while (9)-(12) is run, which the document says needs them at every step",
        ),
    ],
)
def without_inverse_kinematics(assumed: Assumed) -> Result:
    """Calls of the closed-form inverse, counted on a copy of the slave's arm."""
    case, reading = Case.of(assumed), assumed["classical_method"]
    placed, obstacles = placed_slave(case.layout), slave_obstacles(case)
    if obstacles is None or slave_plan(case) is None:
        nothing = {"improved_plan": None, "traditional_plan": None, "postures": None}
        return Result(nothing, NOTHING)
    calls = {
        "improved_plan": improved(case.method, case.layout.window_centre, placed.goal),
        "traditional_plan": traditional(case.method, reading),
    }
    counted, counter = _counting(placed)
    for target in case.layout.slave_points():
        posture(counted.arm, target - case.layout.slave_base, case.layout.slave_postures)
    found = {"postures": len(counter)}
    for name, settings in calls.items():
        counted, counter = _counting(placed)
        plan_apf(counted, placed.start, placed.goal, obstacles, settings)
        found[name] = len(counter)
    return Result(
        obtained=found,
        caption=(
            f"Inverse kinematics is called {found['improved_plan']} times in a run of (13)-(16) "
            f"and {found['traditional_plan']} times in one of (9)-(12): the Jacobian carries the "
            "force to the joints in both. It is the improved method that needs it, once for each "
            "of Start and End, because (13) asks for goal angles where a position is given."
        ),
    )


def _counting(placed: PlacedArm) -> tuple[PlacedArm, list[None]]:
    """The arm with a closed-form inverse that notes every call."""
    arm, calls = copy.copy(placed.arm), []

    def noted(*args: object, **options: object) -> np.ndarray:
        calls.append(None)
        return placed.arm.ik_branches(*args, **options)

    arm.ik_branches = noted
    return PlacedArm(placed.name, arm, placed.placement, placed.start, placed.goal), calls


@checks(
    "xue.claim_better",
    rules=[
        Bounded(key="fewer_missed", low=0.0, label="ability: runs of 10 missed fewer, mean"),
        Bounded(
            key="never_missed_gain", low=0.0, label="robustness: more arrangements without a miss"
        ),
        Bounded(key="length_ratio", high=1.0, label="quality: joint path over traditional, median"),
        Bounded(key="step_ratio", high=1.0, label="efficiency: steps over traditional, median"),
    ],
    samples=4,
)
def superior(assumed: Assumed) -> Result:
    """Four measures of superiority over random arrangements."""
    reading = assumed["classical_method"]
    table, old, new = lottery_table(), missed(reading), missed("improved")
    column = "five_points" if reading == "five_points" else "traditional"
    both = table[(table["slave_reason"] == "reached") & table["traditional_reached"]]
    length = (both["slave_length"] / both["traditional_length"]).median()
    steps = (table["improved_steps_reached"] / table[f"{column}_steps_reached"]).median()
    found = {
        "fewer_missed": float(old.mean() - new.mean()),
        "mean_missed": {"traditional": float(old.mean()), "improved": float(new.mean())},
        "never_missed": {
            "traditional": float((old == 0).mean()),
            "improved": float((new == 0).mean()),
        },
        "never_missed_gain": float((new == 0).mean() - (old == 0).mean()),
        "length_ratio": float(length),
        "step_ratio": float(steps),
    }
    return Result(
        obtained=found,
        table=pd.DataFrame({"traditional_missed": old, "improved_missed": new}),
        caption=(
            f"Over {len(table)} random arrangements the improved method misses "
            f"{found['mean_missed']['improved']:.2f} of 10 runs on average, the traditional one "
            f"{found['mean_missed']['traditional']:.2f}; without a miss are "
            f"{found['never_missed']['improved']:.0%} and "
            f"{found['never_missed']['traditional']:.0%} of the arrangements. Where both arrive, "
            f"the improved path has {length:.2f} times the length in joint space and {steps:.2f} "
            "times the steps (medians)."
        ),
    )
