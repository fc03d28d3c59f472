"""Placements of a job: joint paths, constraints and fitness for many positions of the workpiece."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from ..annotation import real_array
from ..arguments import MASK, Shape, checked
from ..errors import InputError
from ..scene.clearance import blocks as rows_of
from .branches import Status, follow
from .cell import Cell
from .objective import Measures, Objective, inverse_volumes
from .separation import Separation

#: Where a workpiece may be placed: lower and upper bounds of its position (3, 2) [m].
Region = Annotated[np.ndarray, Shape(3, 2)]
_BLOCK = 64


@dataclass(frozen=True, eq=False)
class Jobs:
    """The job at P placements.

    Attributes
    ----------
    centres : ndarray (P, 3)
        Positions C of the workpiece origin in the world [m].
    status : ndarray (P,)
        :class:`.branches.Status`.
    robot : ndarray (P,)
        First robot that cannot do it, -1 if all can.
    branch : ndarray (P, 3)
    q : ndarray (P, 3, N, 6)
        Joint paths [rad], NaN where a robot has none.
    w : ndarray (P, 3, N)
        Manipulabilities [m^3].
    separation : ndarray (P,)
        Smallest distance of all pairs [m]; NaN where it was not needed.
    """

    centres: np.ndarray
    status: np.ndarray
    robot: np.ndarray
    branch: np.ndarray
    q: np.ndarray
    w: np.ndarray
    separation: np.ndarray

    @property
    def feasible(self) -> np.ndarray:
        """Mask (P,)."""
        return self.status == Status.FEASIBLE

    @checked
    def select(self, mask: Annotated[np.ndarray, MASK, Shape("P")]) -> Jobs:
        """The jobs where the mask (P,) is true."""
        if len(mask) != len(self.status):
            raise InputError("Jobs.select", "length of mask", len(mask), str(len(self.status)))
        return Jobs(**{name: values[mask] for name, values in vars(self).items()})


@checked
@dataclass(eq=False)
class Placement:
    """Fitness of positions C: the aggregated measure, 0 where a constraint is violated.

    Attributes
    ----------
    evaluations : int
        How many positions have been asked for.
    """

    cell: Cell
    objective: Objective
    separation: Separation = field(init=False)
    evaluations: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        self.separation = Separation(self.cell)

    def __call__(self, centres: ArrayLike) -> np.ndarray:
        """Fitness (P,) of positions (P, 3) [m]."""
        centres = _positions(centres)
        self.evaluations += len(centres)
        parts = [self.score(self.jobs(block)) for block in blocks(centres)]
        return np.concatenate(parts) if parts else np.empty(0)

    @checked
    def jobs(self, centres: ArrayLike) -> Jobs:
        """Joint paths and constraints at positions (P, 3) [m], cheapest tests first."""
        return solve_jobs(self.cell, self.separation, _positions(centres))

    @checked
    def measures(self, jobs: Jobs) -> Measures:
        """Measures along the seam (P, N) of jobs whose robots all have a path."""
        objective, inverse = self.objective, None
        if objective.uses_volumes:
            inverse = inverse_volumes(self.cell, jobs.q, objective.space, objective.carriers)
        return objective.measures(jobs.w, inverse)

    @checked
    def score(self, jobs: Jobs) -> np.ndarray:
        """Fitness (P,) of jobs."""
        fitness = np.zeros(len(jobs.centres))
        kept = jobs.feasible
        if kept.any():
            system = self.measures(jobs.select(kept)).system
            fitness[kept] = self.objective.aggregate(system)
        return fitness


def solve_jobs(cell: Cell, separation: Separation, centres: np.ndarray) -> Jobs:
    """Follow the seam with every robot in turn, then measure distances where all of them can.

    Parameters
    ----------
    centres : ndarray (P, 3) [m]
    """
    count = len(centres)
    jobs = Jobs(
        centres=centres,
        status=np.zeros(count, dtype=int),
        robot=np.full(count, -1),
        branch=np.full((count, 3), -1),
        q=np.full((count, 3, cell.count, 6), np.nan),
        w=np.full((count, 3, cell.count), np.nan),
        separation=np.full(count, np.nan),
    )
    alive = np.arange(count)
    for k in range(len(cell.arms)):
        found = _followed(cell, k, centres[alive])
        jobs.q[alive, k], jobs.w[alive, k], jobs.branch[alive, k], status = found
        lost = status != Status.FEASIBLE
        jobs.status[alive[lost]], jobs.robot[alive[lost]] = status[lost], k
        alive = alive[~lost]
    jobs.separation[alive] = separation.smallest(jobs.q[alive], centres[alive])
    jobs.status[alive[jobs.separation[alive] <= 0]] = Status.COLLISION
    return jobs


def statuses(cell: Cell, centres: np.ndarray) -> np.ndarray:
    """Status of every robot alone at positions (P, 3), whatever becomes of the others -> (P, R)."""
    return np.column_stack([_followed(cell, k, centres)[3] for k in range(len(cell.arms))])


def _followed(cell: Cell, robot: int, centres: np.ndarray) -> tuple[np.ndarray, ...]:
    """Joint paths of one robot, see :func:`.branches.follow`."""
    flanges, at = np.ascontiguousarray(cell.flanges[robot]), np.ascontiguousarray(centres)
    geometry, base = cell.geometries[robot], cell.bases[robot]
    found: tuple[np.ndarray, ...] = follow(
        *(geometry, base, flanges, at, *cell.limits(robot), cell.threshold)
    )
    return found


def _positions(centres: ArrayLike) -> np.ndarray:
    try:
        array = real_array(centres)
    except (TypeError, ValueError):
        raise InputError("placement", "centres", centres, "finite positions, (P, 3) [m]") from None
    if array.ndim != 2 or array.shape[1] != 3 or not np.isfinite(array).all():
        raise InputError("placement", "centres", centres, "finite positions, shape (P, 3) [m]")
    return array


def blocks(points: np.ndarray) -> Iterator[np.ndarray]:
    """The points in portions whose jobs fit in memory."""
    return (points[rows] for rows in rows_of(len(points), _BLOCK))
