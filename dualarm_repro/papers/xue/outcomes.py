"""Seeded trials of the slave with whole planners and with parts of them: how many miss, and why.

Its start angles vary, since print names no variation.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ...ledger.comparison import Comparison
from ...planning.descent.batch import perturbed
from ...planning.descent.problem import PlanningProblem, problem
from ...planning.settings import APFSettings
from ...planning.trials.outcome import Outcome, outcome
from ...planning.trials.runs import Runs, run_trials
from .motions import slave_task
from .reading import Case, improved, traditional

TRIALS = 10


class Variant(NamedTuple):
    """A planner with some of its parts, and how a page names it."""

    title: str
    settings: Callable[[Case], APFSettings]

    def problem(self, case: Case) -> PlanningProblem:
        """The problem of the slave with this planner."""
        placed, obstacles = slave_task(case)
        return problem(placed, placed.start, placed.goal, obstacles, self.settings(case))


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
    """Start angles of the slave, uniformly perturbed, (count, 6) [rad]."""
    return perturbed(slave_task(case)[0].start, half_width, count, rng)


def outcomes(case: Case, names: Sequence[str], begin: np.ndarray) -> dict[str, Any]:
    """Outcomes of several planners from the same starts, in flat columns ``<planner>_<field>``."""
    columns: dict[str, Any] = {}
    for name, runs in run_variants(case, names, begin).items():
        found = summary(case, name, runs)._asdict()
        columns |= {f"{name}_{field}": value for field, value in found.items()}
    return columns


def run_variants(case: Case, names: Sequence[str], begin: np.ndarray) -> dict[str, Runs]:
    """Runs of several planners from the same starts.

    A virtual point that is switched on in a trap changes nothing of a run that meets none, so the
    improved method is run only where it fails without that point, if that is among the planners.
    """
    made = {name: run_variant(case, name, begin) for name in names if name != "improved"}
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


def run_variant(case: Case, name: str, begin: np.ndarray) -> Runs:
    """Runs of one planner."""
    placed, obstacles = slave_task(case)
    return run_trials(placed, begin, obstacles, VARIANTS[name].settings(case))


def summary(case: Case, name: str, runs: Runs) -> Outcome:
    """Counts and means of some runs, each pushed in the same way where it stands still."""
    return outcome(VARIANTS[name].problem(case), runs, np.random.default_rng(0))
