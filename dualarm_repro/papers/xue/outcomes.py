"""Seeded trials of the slave with whole planners and with parts of them: how many miss, and why.

Its start angles vary, since print names no variation.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ...errors import InputError
from ...ledger.comparison import Comparison
from ...planning.descent.batch import perturbed, plan_batch
from ...planning.descent.cartesian_ik import plan_cartesian_ik, plan_cartesian_ik_batch
from ...planning.descent.compiled import plan_apf_compiled
from ...planning.descent.problem import PlanningProblem, problem
from ...planning.master_slave import Planner
from ...planning.plan import Plan
from ...planning.settings import APFSettings
from ...planning.trials.outcome import Outcome, outcome
from ...planning.trials.runs import BatchPlanner, Runs, attempt, run_trials, touching
from .motions import slave_task
from .reading import POSITION_TOLERANCE, Case, improved, traditional

TRIALS = 10
#: Readings of the traditional method, as the assumption ``classical_method`` names them, and the
#: criteria by which it succeeds.
READINGS = ("end_effector", "five_points", "cartesian_ik")
CRITERIA = ("position", "goal_angles")
_BLOCKS = 100  # of starts that are drawn before an arrangement is given up


class Variant(NamedTuple):
    """A planner with some of its parts, and how a page names it."""

    title: str
    settings: Callable[[Case], APFSettings]
    single: Planner = plan_apf_compiled
    batch: BatchPlanner = plan_batch

    def problem(self, case: Case) -> PlanningProblem:
        """The problem of the slave with this planner, in whose field a standstill is judged."""
        placed, obstacles = slave_task(case)
        settings = self.settings(case)
        if self.batch is plan_cartesian_ik_batch:
            settings = traditional(case.planner, "end_effector")
        return problem(placed, placed.start, placed.goal, obstacles, settings)

    def plan(self, case: Case) -> Plan | None:
        """From the start of the slave; None where it touches an obstacle."""
        placed, obstacles = slave_task(case)
        return attempt(placed, placed.start, obstacles, self.settings(case), self.single)


def _improved(case: Case, switching: str | None = None, **parts: Any) -> APFSettings:
    planner, goal = case.planner, slave_task(case)[0].goal
    if switching is not None:
        planner = replace(planner, virtual_switching=switching)
    return improved(planner, case.layout.window_centre, goal, **parts)


#: What may free the arm, one part at a time. The first two are the methods of Table 2.
VARIANTS: dict[str, Variant] = {
    "traditional": Variant(
        "(9), (10) at the end effector", lambda case: traditional(case.planner, "end_effector")
    ),
    "improved": Variant("(13)-(16), virtual point as assumed", _improved),
    "without_virtual": Variant("(13)-(16), no virtual point", partial(_improved, virtual=False)),
    "five_points": Variant(
        "(9), (10) at five points", lambda case: traditional(case.planner, "five_points")
    ),
    "cartesian_ik": Variant(
        "(9), (10) for a point, inverse kinematics",
        lambda case: traditional(case.planner, "five_points"),
        plan_cartesian_ik,
        plan_cartesian_ik_batch,
    ),
    "traditional_virtual": Variant(
        "(9), (10) with virtual point",
        lambda case: traditional(case.planner, "end_effector", case.layout.window_centre),
    ),
    "joint_term": Variant(
        "joint term alone, no virtual point", partial(_improved, virtual=False, position_weight=0.0)
    ),
    "replaces_goal": Variant(
        "(13)-(16), virtual point replaces the goal", partial(_improved, switching="replaces_goal")
    ),
    "from_start": Variant(
        "(13)-(16), virtual point from the start", partial(_improved, switching="from_start")
    ),
    "always": Variant("(13)-(16), virtual point always", partial(_improved, switching="always")),
}


_DELICATE = "a descent along a crease amplifies round-off"
#: How outcomes and motions are compared with stored ones. A descent that runs along a crease of
#: the potential, or halts on one, amplifies round-off: another processor may end such a run
#: elsewhere. Of 1000 arrangements computed twice, with other machine code, six differed: a gradient
#: by 2.4e-6 of itself, a path by 1.5e-6, a distance by 7e-6 m, mean steps by 0.5 %, and no count.
DESCENTS = (
    Comparison("*_gradient", _DELICATE, relative=1e-4),
    Comparison("*_steps_*", _DELICATE, relative=0.02),
    Comparison("*_length", _DELICATE, relative=1e-4),
    Comparison("*_path", _DELICATE, relative=1e-4),
    Comparison("cores_*", _DELICATE, absolute=1e-4),
    Comparison("flanges_apart", _DELICATE, absolute=1e-4),
    Comparison("slave_*", _DELICATE, absolute=1e-4),
    *(
        Comparison(f"*_{name}", "one run may end on the other side", absolute=1)
        for name in ("missed", "trapped", "stationary", "held", "used", "rescued")
    ),
)


def variant_of(method: str) -> str:
    """The planner that a method means; ``end_effector`` is the usual reading of the traditional."""
    return "traditional" if method == "end_effector" else method


def starts(case: Case, half_width: float, count: int, rng: np.random.Generator) -> np.ndarray:
    """Start angles of the slave, uniformly perturbed, that touch nothing, (count, 6) [rad]."""
    return clear_starts(case, half_width, count, rng)[0]


def clear_starts(
    case: Case, half_width: float, count: int, rng: np.random.Generator
) -> tuple[np.ndarray, int]:
    """The same, and how many were left out because a point of some method touches an obstacle.

    The methods look with different points, so that a start in contact would be a miss of one of
    them and a run of the other.

    Raises
    ------
    InputError
        Nearly all starts touch an obstacle.
    """
    placed, left_out = slave_task(case)[0], 0
    made = [VARIANTS[name].problem(case) for name in ("traditional", "improved")]
    found: list[np.ndarray] = []
    for _ in range(_BLOCKS):
        drawn = perturbed(placed.start, half_width, count, rng)
        for q, out in zip(
            drawn, np.any([touching(one, drawn) for one in made], axis=0), strict=True
        ):
            if len(found) < count:
                left_out += int(out)
                found += [q] * (not out)
        if len(found) == count:
            return np.array(found), left_out
    raise InputError("arrangement", "starts of trials", left_out, "some that touch no obstacle")


def outcomes(case: Case, names: Sequence[str], begin: np.ndarray) -> dict[str, Any]:
    """Outcomes of several planners from the same starts, in flat columns ``<planner>_<field>``."""
    columns: dict[str, Any] = {}
    for name, runs in run_variants(case, names, begin).items():
        found = summary(case, name, runs)._asdict()
        columns |= {f"{name}_{field}": value for field, value in found.items()}
    return columns


def run_variants(
    case: Case, names: Sequence[str], begin: np.ndarray, criterion: str = "position"
) -> dict[str, Runs]:
    """Runs of several planners from the same starts; ``criterion`` is that of the traditional.

    A virtual point that is switched on in a trap changes nothing of a run that meets none, so the
    improved method is run only where it fails without that point, if that is among the planners.
    """
    made = {name: run_variant(case, name, begin, criterion) for name in names if name != "improved"}
    if "improved" in names:
        plain = made.get("without_virtual")
        if plain is None or case.planner.virtual_switching != "on_when_stuck":
            made["improved"] = run_variant(case, "improved", begin)
        elif plain.reached.all():
            made["improved"] = plain
        else:
            again = run_variant(case, "improved", begin[~plain.reached])
            made["improved"] = plain.replaced(~plain.reached, again)
    return made


def run_variant(case: Case, name: str, begin: np.ndarray, criterion: str = "position") -> Runs:
    """Runs of one planner.

    Parameters
    ----------
    criterion
        Where a reading of the traditional method has to arrive: ``position``, or ``goal_angles`` as
        is printed for a successful run.
    """
    placed, obstacles = slave_task(case)
    variant = VARIANTS[name]
    settings = variant.settings(case)
    if criterion == "goal_angles" and name in map(variant_of, READINGS):
        to_angles = settings.termination.changed(
            joint_tolerance=case.planner.goal_tolerance, position_tolerance=None
        )
        settings = settings.changed(termination=to_angles)
    return run_trials(placed, begin, obstacles, settings, variant.batch)


def summary(case: Case, name: str, runs: Runs) -> Outcome:
    """Counts and means of some runs; one that rests at the goal position is in no trap."""
    return outcome(VARIANTS[name].problem(case), runs, at_goal=POSITION_TOLERANCE)
