"""The fitness over a region: a survey on a grid, mirror images, and positions that a rule picks."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arguments import Count, Positive, checked
from ..arms.wrist_ik import inverse_kinematics
from ..errors import UnknownNameError
from .branches import Status
from .cell import WELDER, Cell
from .genetic import Fitness, checked_box
from .grid_search import Optimum, best_cells, grid_points, refined
from .placement import Placement, Region, blocks

_MIRROR = np.array([-1.0, 1.0, 1.0])
_SAME = 1e-6  # relative difference of the fitness of two mirror images
#: Of an extreme and its mirror image the one on this side is meant.
_SIDE = np.array([1.0, 0.0, 0.0])
#: Rule to a score (P,) from manipulabilities (P, 3, N) and system measure (P, N).
EXTREMES = {
    "lowest_welder": lambda w, system: 1.0 / w[:, WELDER].max(axis=1),
    "lowest_mean_of_welder": lambda w, system: 1.0 / w[:, WELDER].mean(axis=1),
    "largest_variation": lambda w, system: system.std(axis=1) / system.mean(axis=1),
    "largest_swing": lambda w, system: np.ptp(system, axis=1) / system.max(axis=1),
    "nearest_singularity": lambda w, system: 1.0 / w.min(axis=(1, 2)),
}


class Survey(NamedTuple):
    """A grid over the region: points (P, 3), fitness (P,) and status of the constraints (P,)."""

    points: np.ndarray
    fitness: np.ndarray
    status: np.ndarray


@checked
def survey(placement: Placement, box: Region, spacing: Positive) -> Survey:
    """Fitness and constraints on the :func:`.grid_search.grid_points` of the region."""
    points, rated = grid_points(box, spacing), []
    for block in blocks(points):
        jobs = placement.jobs(block)
        rated.append((placement.score(jobs), jobs.status))
    return Survey(points, *map(np.concatenate, zip(*rated, strict=True)))


def nearer_image(found: Optimum, fitness: Fitness, target: np.ndarray) -> Optimum:
    """The optimum or its mirror image in the plane x = 0, the one nearer to a target.

    The image counts only if it is as good, to a millionth, or better.
    """
    image = found.position * _MIRROR
    nearer = np.linalg.norm(image - target) < np.linalg.norm(found.position - target)
    if not (found.fitness and nearer):
        return found
    value = float(fitness(image[np.newaxis])[0])
    same = value >= found.fitness * (1 - _SAME)
    return found._replace(position=image, fitness=value) if same else found


def reaches_point(cell: Cell, centres: np.ndarray, point: int) -> np.ndarray:
    """Whether every robot reaches one seam point within its limits, (P, 3) [m] -> mask (P,)."""
    reached = np.ones(len(centres), dtype=bool)
    for k, geometry in enumerate(cell.geometries):
        poses = np.tile(cell.flanges[k, point], (len(centres), 1, 1))
        poses[:, :3, 3] += centres
        local = np.linalg.inv(cell.bases[k]) @ poses
        found = inverse_kinematics(geometry, local, np.zeros(6), *cell.limits(k))
        reached &= ~np.isnan(found[..., 0]).all(axis=1)
    return reached


@checked
def extreme_position(
    placement: Placement,
    box: Region,
    rule: str,
    *,
    spacing: Positive,
    starts: Count,
    tolerance: Positive = 1e-3,
    known: Survey | None = None,
) -> Optimum:
    """Feasible position that a rule calls poor, and its score.

    Of two mirror images of one score, the one with x > 0.

    Parameters
    ----------
    rule : str
        A key of :data:`EXTREMES`: ``lowest_welder`` (its largest manipulability along the seam is
        smallest), ``lowest_mean_of_welder``, ``largest_variation`` (coefficient of variation of
        the system measure), ``largest_swing`` (its range over its maximum) or
        ``nearest_singularity`` (the smallest manipulability of any robot is smallest).
    spacing, starts, tolerance
        As in :func:`.grid_search.grid_optimum`.
    known : Survey, optional
        Of this job and spacing, with any measure and threshold: the rest need not be scored again.

    Returns
    -------
    Optimum
        Its position is NaN if no position of the grid is feasible.

    Raises
    ------
    UnknownNameError
        No such rule.
    """
    if rule not in EXTREMES:
        raise UnknownNameError("extreme position", "rule", rule, f"one of {', '.join(EXTREMES)}")

    def score(points: np.ndarray) -> np.ndarray:
        jobs = placement.jobs(points)
        values = np.zeros(len(points))
        if jobs.feasible.any():
            part = jobs.select(jobs.feasible)
            values[jobs.feasible] = EXTREMES[rule](part.w, placement.measures(part).system)
        return values

    box = checked_box(box)
    points = grid_points(box, spacing) if known is None else known.points
    if known is not None:
        points = points[np.isin(known.status, (Status.FEASIBLE, Status.SINGULAR))]
    values = np.concatenate([np.empty(0), *(score(block) for block in blocks(points))])
    cells = best_cells(points, values, starts, spacing)
    found = refined(score, cells, box, 0.5 * spacing, tolerance)
    image = nearer_image(found, score, _SIDE)
    return image if image.fitness <= found.fitness * (1 + _SAME) else found
