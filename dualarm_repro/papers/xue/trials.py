"""Seeded trials of the slave; its start angles vary, since print names no variation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import minimize
from scipy.stats import binomtest

from ...planning.descent.batch import perturbed, plan_batch
from ...planning.descent.problem import problem
from ...planning.descent.termination import StopReason, within
from ...planning.settings import APFSettings
from .layout import placed_slave
from .methods import improved, joint_term_only, traditional
from .motions import Case, slave_obstacles

TRIALS = 10
#: |dU/dq| below which a configuration counts as stationary; the gradient at the start is about ten.
FLAT = 1e-3
_POLISH = 100
#: Joint distance within which a stationary point counts as that of a run [rad].
_NEAR = 0.1
#: Size of a push at rest [rad], how many there are, and the share of the motion that counts as rest
#: of any other run after it: a saddle is left slowly.
PUSH = 1e-3
_PUSHES = 8
_PATIENCE = 1e-3
#: Reason of a run whose perturbed start touches an obstacle.
TOUCHES = "start-touches-obstacle"


class Ablation(NamedTuple):
    """A planner with some of its parts, and how a page names it."""

    title: str
    settings: Callable[[Case], APFSettings]


def _improved(case: Case, **changed: str) -> APFSettings:
    method = replace(case.method, **changed)
    return improved(method, case.layout.window_centre, _goal(case))


#: What may free the arm, one part at a time. The first two are the methods of Table 2.
METHODS: dict[str, Ablation] = {
    "traditional": Ablation(
        "(9), (10) at the end effector", lambda case: traditional(case.method, "end_effector")
    ),
    "improved": Ablation("(13)-(16), virtual point as assumed", _improved),
    "without_virtual": Ablation(
        "(13)-(16), no virtual point",
        lambda case: improved(case.method, case.layout.window_centre, _goal(case), virtual=False),
    ),
    "five_points": Ablation(
        "(9), (10) at five points", lambda case: traditional(case.method, "five_points")
    ),
    "traditional_virtual": Ablation(
        "(9), (10) with virtual point",
        lambda case: traditional(case.method, "end_effector", case.layout.window_centre),
    ),
    "joint_term": Ablation(
        "joint term alone, no virtual point", lambda case: joint_term_only(case.method)
    ),
    "replaces_goal": Ablation(
        "(13)-(16), virtual point replaces the goal",
        partial(_improved, virtual_switching="replaces_goal"),
    ),
    "from_start": Ablation(
        "(13)-(16), virtual point from the start",
        partial(_improved, virtual_switching="from_start"),
    ),
    "always": Ablation(
        "(13)-(16), virtual point always", partial(_improved, virtual_switching="always")
    ),
}


class Outcome(NamedTuple):
    """Trials of one method.

    ``missed`` counts the runs that did not arrive, ``trapped`` those of them that were seen to
    stand still, ``stationary`` those of these where the gradient is certified to vanish, and
    ``held`` those that stay after small pushes too: a saddle does not hold an arm for good.
    ``used`` and ``rescued``: the virtual point acted, and acted with success. ``gradient`` is the
    largest |dU/dq| where a run stood still.
    """

    runs: int
    missed: int
    trapped: int
    stationary: int
    held: int
    used: int
    rescued: int
    steps_reached: float
    steps_all: float
    gradient: float


class Runs(NamedTuple):
    """Ends of the runs of one method, one row each."""

    reason: np.ndarray
    steps: np.ndarray
    last: np.ndarray
    gradient: np.ndarray
    used: np.ndarray
    rescued: np.ndarray


def starts(case: Case, half_width: float, count: int, rng: np.random.Generator) -> np.ndarray:
    """Start angles of the slave, uniformly perturbed, (count, 6) [rad]."""
    return perturbed(placed_slave(case.layout).start, half_width, count, rng)


def outcomes(case: Case, methods: Sequence[str], begin: np.ndarray) -> dict[str, Any]:
    """Outcomes of several methods from the same starts, in flat columns ``<method>_<field>``."""
    columns: dict[str, Any] = {}
    for method, runs in run_methods(case, methods, begin).items():
        found = summary(case, method, runs)._asdict()
        columns |= {f"{method}_{name}": value for name, value in found.items()}
    return columns


def run_methods(case: Case, methods: Sequence[str], begin: np.ndarray) -> dict[str, Runs]:
    """Runs of several methods from the same starts.

    A virtual point that is switched on in a trap changes nothing of a run that meets none, so the
    improved method is run only where it fails without that point, if that is among the methods.
    """
    made = {method: run_trials(case, method, begin) for method in methods if method != "improved"}
    if "improved" in methods:
        plain = made.get("without_virtual")
        made["improved"] = (
            run_trials(case, "improved", begin)
            if plain is None or case.method.virtual_switching != "on_when_stuck"
            else _rerun(case, begin, plain)
        )
    return made


def _rerun(case: Case, begin: np.ndarray, plain: Runs) -> Runs:
    missed = plain.reason != StopReason.REACHED
    if not missed.any():
        return plain
    again = run_trials(case, "improved", begin[missed])
    runs = Runs(*(part.copy() for part in plain))
    for part, new in zip(runs, again, strict=True):
        part[missed] = new
    return runs


def run_trials(case: Case, method: str, begin: np.ndarray) -> Runs:
    """One run per start; a start that touches an obstacle ends there with that reason."""
    placed, obstacles = placed_slave(case.layout), slave_obstacles(case)
    settings = METHODS[method].settings(case)
    made = problem(placed, placed.start, placed.goal, obstacles, settings)
    clear = made.repulsion.distances(begin).min(axis=(1, 2)) > 0.0
    count = len(begin)
    runs = Runs(
        np.full(count, TOUCHES, dtype=object),
        np.zeros(count, dtype=int),
        begin.copy(),
        np.zeros(count),
        np.zeros(count, dtype=bool),
        np.zeros(count, dtype=bool),
    )
    if clear.any():
        batch = plan_batch(placed, begin[clear], placed.goal, obstacles, settings)
        found = (
            np.array(batch.reason, dtype=object),
            batch.steps,
            batch.last,
            batch.gradient_norm,
            batch.activations > 0,
            batch.rescued,
        )
        for part, new in zip(runs, found, strict=True):
            part[clear] = new
    return runs


def summary(case: Case, method: str, runs: Runs) -> Outcome:
    """Counts and means of some runs; a mean over no run is NaN."""
    reached = runs.reason == StopReason.REACHED
    stuck = np.isin(runs.reason, (StopReason.TRAPPED, StopReason.NEAR_OBSTACLE))
    return Outcome(
        runs=len(reached),
        missed=int((~reached).sum()),
        trapped=int(stuck.sum()),
        stationary=_stationary(case, method, runs.last[stuck], runs.gradient[stuck]),
        held=_held(case, method, runs.last[stuck]),
        used=int(runs.used.sum()),
        rescued=int(runs.rescued.sum()),
        steps_reached=_mean(runs.steps[reached]),
        steps_all=_mean(runs.steps),
        gradient=float(runs.gradient[stuck].max(initial=0.0)),
    )


def _stationary(case: Case, method: str, last: np.ndarray, gradient: np.ndarray) -> int:
    """How many runs that stand still do so where dU/dq = 0, U = U_att + U_rep, obstacles at rest.

    That is certain where |dU/dq| <= FLAT. A run that still creeps when its motion is judged to have
    stopped lies next to one if a descent that may not leave the ``_NEAR`` neighbourhood ends inside
    it, with a gradient that small and away from the goal.
    """
    count = int((gradient <= FLAT).sum())
    if count == len(last):
        return count
    placed, obstacles = placed_slave(case.layout), slave_obstacles(case)
    settings = METHODS[method].settings(case)
    made = problem(placed, placed.start, placed.goal, obstacles, settings)
    rest = len(obstacles.cores) - 1
    for q in last[gradient > FLAT]:
        end = minimize(
            made.field.value,
            q,
            (rest,),
            jac=made.field.gradient,
            method="L-BFGS-B",
            bounds=np.column_stack([q - _NEAR, q + _NEAR]),
            options={"gtol": 0.1 * FLAT, "ftol": 0.0, "maxiter": _POLISH},
        ).x
        flat = np.linalg.norm(made.field.gradient(end, rest)) <= FLAT
        count += bool(flat and not within(*made.errors(end), *made.tolerances))
    return count


def _held(case: Case, method: str, last: np.ndarray) -> int:
    """How many runs that stand still do not arrive after any of some small pushes, which draws away
    what rests on a saddle or on the rim of a valley; all obstacles at rest."""
    if not len(last):
        return 0
    placed, moving = placed_slave(case.layout), slave_obstacles(case)
    obstacles = replace(moving, cores=moving.cores[-1:], boxes=moving.boxes[-1:])
    settings, rng = METHODS[method].settings(case), np.random.default_rng(0)
    trap = settings.termination.trap
    patient = trap.changed(threshold=_PATIENCE * trap.threshold)
    settings = settings.changed(termination=settings.termination.changed(trap=patient))
    made = problem(placed, placed.start, placed.goal, obstacles, settings)
    held = 0
    for q in last:
        pushed = q + rng.uniform(-PUSH, PUSH, (_PUSHES, len(q)))
        clear = made.repulsion.distances(pushed).min(axis=(1, 2), initial=np.inf) > 0.0
        runs = clear.any() and plan_batch(placed, pushed[clear], placed.goal, obstacles, settings)
        held += not (runs and runs.reached.any())
    return held


def wilson(count: int, runs: int) -> tuple[float, float]:
    """95 % confidence interval of a share after Wilson."""
    found = binomtest(count, runs).proportion_ci(method="wilson")
    return float(found.low), float(found.high)


def _goal(case: Case) -> np.ndarray:
    return placed_slave(case.layout).goal


def _mean(values: np.ndarray) -> float:
    return float(values.mean()) if len(values) else float("nan")
