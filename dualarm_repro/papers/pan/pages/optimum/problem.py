"""The optimization problem of `pan`: its printed objective and constraints, tested one by one."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from .....errors import DataFileError
from .....ledger import REGISTRY, Assumed, Bounded, Is, Result
from .....ledger.captions import captions
from .....view.landscape import slices_figure
from .....welding import (
    ROBOTS,
    Cell,
    Jobs,
    Optimum,
    Placement,
    Separation,
    Status,
    Survey,
    joint_margin,
)
from .....welding.between import certified_separation
from .....welding.motion import smallest_rank
from ...document import printed_optimum
from ...print_forms import holds, printed_text, value
from ...reading import (
    SPACING,
    Problem,
    denser,
    measures_at,
    nothing_feasible,
    optimum,
    solved,
    surveyed,
)

checks = partial(REGISTRY.checks, page="pan/optimum")
caption = captions(__file__)
_CONSTRAINTS = {
    "joint angles within limits": Status.JOINT_LIMITS,
    "away from singularities": Status.SINGULAR,
    "no collision": Status.COLLISION,
    "inside the common workspace": Status.OUT_OF_REACH,
}
_SAME = 1e-12
_TESTED = 24  # positions of each status


@checks(
    "pan.eq_opt",
    rules=[
        Is("variables", "variables that are searched", to="over"),
        Is(
            "objective_is_printed",
            "the fitness of the best position is the printed objective there",
            value=True,
        ),
        Bounded(
            "disagreements",
            "positions where the printed constraints and the search disagree",
            high=0.0,
        ),
        Bounded("better", "points of a second grid that are better", high=0.0),
    ],
)
def problem(assumed: Assumed) -> Result:
    """Feasible set and maximum of the declared problem, against what is printed."""
    task = Problem.of(assumed)
    placement, grid, bounds, best = task.placement(), surveyed(task), task.box, optimum(task)
    if not best.fitness:
        return nothing_feasible("variables", "objective_is_printed", "disagreements", "better")
    second = grid.points + 0.5 * SPACING
    values = placement(second[(second <= bounds[:, 1]).all(axis=1)])
    gap = _objective_gap(task, best)
    edge = float(np.minimum(best.position - bounds[:, 0], bounds[:, 1] - best.position).min())
    return Result(
        obtained={
            "variables": list("xyz")[: len(best.position)],
            "objective_is_printed": gap < _SAME,
            "objective_gap": gap,
            "disagreements": constraint_disagreements(task, grid.status),
            "better": int((values > best.fitness * (1 + 1e-9)).sum()),
            "feasible_share": float((grid.fitness > 0).mean()),
            "to_edge": edge,
            "optimum": best.position.tolist(),
            "fitness": best.fitness,
        },
        caption=caption("eq_opt", second=len(values)),
        alt="Three slices of the fitness with the feasible set, the optimum and the printed point.",
        figure=lambda: slices_figure(
            placement, _shown(grid, bounds), best.position, best.fitness, printed_optimum()
        ),
    )


@checks(
    "pan.claim_constraints",
    rules=[
        Is("count", "constraints tested", to="count"),
        Bounded(
            "separation",
            "separation certified on a denser seam and between its points [m]",
            low=0.0,
        ),
        Bounded("joint_margin", "smallest margin to a joint limit there [deg]", low=0.0),
        Bounded("rank", "smallest rank of a Jacobian there", low=6),
        Is("reached", "every robot reaches every point of it", value=True),
    ],
)
def constraints(assumed: Assumed) -> Result:
    """The constraints at the optimum on a denser seam, and what each excludes of the region."""
    task = Problem.of(assumed)
    best, fine = optimum(task), denser(task.job)
    if not best.fitness:
        return nothing_feasible("count", "separation", "joint_margin", "rank", "reached")
    cell, jobs = fine.cell(), solved(fine, tuple(best.position))
    if not jobs.feasible[0]:  # what is violated then shows on the paths without limits
        jobs = Placement(cell.unlimited(), task.measure.reading()).jobs([best.position])
    reached = bool(np.isfinite(jobs.q).all())
    status = surveyed(task).status
    excluded = {name: float((status == cause).mean()) for name, cause in _CONSTRAINTS.items()}
    obtained = {"count": len(set(Status)) - 1, "reached": reached, "excluded": excluded}
    if not reached:
        missing = dict.fromkeys(("separation", "joint_margin", "rank"))
        return Result(obtained=obtained | missing, caption=caption("claim_constraints"))
    nearest = _nearest_pairs(cell, jobs)
    return Result(
        obtained=obtained
        | {
            "separation": certified_separation(cell, jobs).lower,
            "joint_margin": float(np.degrees(joint_margin(cell, jobs))),
            "rank": smallest_rank(cell, jobs),
            "separations": nearest.to_dict(),
        },
        table=nearest.rename("separation_m").rename_axis("pair").reset_index(),
        caption=caption("claim_constraints", points=fine.seam_points),
    )


def _shown(grid: Survey, bounds: np.ndarray) -> np.ndarray:
    """The part of the region that holds feasible positions and the printed point (3, 2) [m]."""
    held = np.vstack([grid.points[grid.fitness > 0], printed_optimum()])
    low, high = held.min(axis=0) - 2 * SPACING, held.max(axis=0) + 2 * SPACING
    return np.column_stack([np.maximum(low, bounds[:, 0]), np.minimum(high, bounds[:, 1])])


def constraint_disagreements(task: Problem, status: np.ndarray) -> int:
    """Positions at which the printed constraints, tested on joint paths, contradict the search.

    ``status`` (P,) is that of the points of the survey.
    All must hold where the search finds a position feasible; where it drops one for a collision or
    for joint limits, one of them must fail on the path that leaves limits aside. Singular ones are
    left out: the search keeps a distance from singularities, which full rank does not.
    """
    cell, points, wrong = task.job.cell(), surveyed(task).points, 0
    printed = printed_text("pan.eq_opt", "subject_to")
    for kind in (Status.FEASIBLE, Status.COLLISION, Status.JOINT_LIMITS):
        chosen = points[status == kind]
        chosen = chosen[:: max(1, len(chosen) // _TESTED)]
        placement = task.job.placement()
        placement.cell = cell.unlimited() if kind is Status.JOINT_LIMITS else cell
        for jobs in (placement.jobs([centre]) for centre in chosen):
            if not np.isfinite(jobs.q).all():
                continue
            given = _given(cell, jobs, task.box)
            met = [_met(text, given) for text in printed]
            wrong += all(met) is not (kind is Status.FEASIBLE)
    return wrong


def _given(cell: Cell, jobs: Jobs, box: np.ndarray) -> dict[str, Any]:
    """Values of the names in the printed constraints, on a joint path."""
    centre, q = jobs.centres[0], jobs.q[0]
    limits = np.array([cell.limits(k) for k in range(len(ROBOTS))])
    separation = Separation(cell)
    return {
        "c": centre,
        "S": box,
        "theta": q,
        "theta_low": limits[:, 0, np.newaxis],
        "theta_high": limits[:, 1, np.newaxis],
        "J": np.array([arm.jacobian(path) for arm, path in zip(cell.arms, q, strict=True)]),
        "Rank": np.linalg.matrix_rank,
        "m": 6,
        "n": 6,
        "min": lambda *values: np.min(values),
        "SD_min": separation.smallest(jobs.q, jobs.centres)[0],
        # |p - q|, least over two bodies, is the signed distance of the pair.
        "p": separation.per_pair(jobs.q, jobs.centres)[0],
        "q": 0.0,
        "norm": lambda gap: gap,
    }


def _met(text: str, given: dict[str, Any]) -> bool:
    """Whether a printed constraint holds; False if it cannot be read."""
    member = re.fullmatch(r"\s*(\w+) in (\w+)\s*", text)
    if member:
        place, box = (np.asarray(given.get(name)) for name in member.groups())
        if (*place.shape, 2) != box.shape:
            return False
        return bool((place >= box[:, 0]).all() and (place <= box[:, 1]).all())
    try:
        return holds(text, given)
    except (DataFileError, ValueError, TypeError):
        return False


def _objective_gap(task: Problem, best: Optimum) -> float:
    """Printed objective, aggregated over the seam, less the fitness that was maximised."""
    found = measures_at(task, best.position)
    mmr = measures_at(replace(task, measure=replace(task.measure, objective="mmr")), best.position)
    given = {"MMR": mmr.system, "M_tight": found.tight, "M_loose": found.loose}
    try:
        curve = value(printed_text("pan.eq_opt", "maximize"), given)
    except DataFileError:
        return float("inf")
    return float(abs(task.measure.reading().aggregate(np.asarray(curve)) - best.fitness))


def _nearest_pairs(cell: Cell, jobs: Jobs) -> pd.Series:
    separation = Separation(cell)
    pairs = separation.per_pair(jobs.q, jobs.centres)[0]
    owners = pd.Series(pairs, index=[" - ".join(pair) for pair in separation.owners])
    return owners.groupby(level=0).min().sort_values()
