"""The optimum of the declared problem, by a grid whose best cells are refined."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...tracking import memo
from ...welding import Jobs, Measures, Optimum
from ...welding.grid_search import best_cells, grid_points, refined
from .scenario import Job, Measure, printed_optimum

Box = tuple[tuple[float, float], ...]
SPACING, STARTS, TOLERANCE = 0.1, 4, 1e-5  # [m], cells, [m]
_MIRROR = np.array([-1.0, 1.0, 1.0])
_SAME = 1e-6  # relative difference of the fitness of two mirror images


#: Answers kept: small ones of every draw, large ones of the last few.
_SMALL, _LARGE = 4096, 16
_BLOCKS = 64


class Survey(NamedTuple):
    """A grid over the region: points (P, 3), fitness (P,) and status of the constraints (P,)."""

    points: np.ndarray
    fitness: np.ndarray
    status: np.ndarray


@memo(_LARGE)
def survey(job: Job, measure: Measure, box: Box) -> Survey:
    """Fitness and constraints on the grid from which the optimum is refined."""
    placement = job.placement(measure.reading())
    points = grid_points(np.array(box), SPACING)
    fitness, status = [], []
    for block in np.array_split(points, _BLOCKS):
        jobs = placement.jobs(block)
        found = np.zeros(len(block))
        if jobs.feasible.any():
            system = placement.measures(jobs.select(jobs.feasible)).system
            found[jobs.feasible] = placement.objective.aggregate(system)
        fitness.append(found)
        status.append(jobs.status)
    return Survey(points, np.concatenate(fitness), np.concatenate(status))


@memo(_SMALL)
def optimum(job: Job, measure: Measure, box: Box) -> Optimum:
    """Best position in the box; of two mirror images the one nearer to the printed point.

    The position is NaN if no position of the grid is feasible.
    """
    placement, grid = job.placement(measure.reading()), survey(job, measure, box)
    cells = best_cells(grid.points, grid.fitness, STARTS, SPACING)
    found = refined(placement, cells, np.array(box), 0.5 * SPACING, TOLERANCE)
    if not found.fitness:
        return found
    image = float(placement([found.position * _MIRROR])[0])
    return nearer_image(found, image)


def nearer_image(found: Optimum, mirrored_fitness: float) -> Optimum:
    """The optimum or its mirror image in x = 0, the one nearer to print, if both are as good."""
    image = found.position * _MIRROR
    printed = printed_optimum()
    nearer = np.linalg.norm(image - printed) < np.linalg.norm(found.position - printed)
    if nearer and mirrored_fitness >= found.fitness * (1 - _SAME):
        return found._replace(position=image, fitness=mirrored_fitness)
    return found


@memo(_LARGE)
def solved(job: Job, position: tuple[float, float, float]) -> Jobs:
    """Joint paths and constraints of the job at one position."""
    return job.placement().jobs([position])


def measures_at(job: Job, measure: Measure, position: np.ndarray) -> Measures:
    """Measures along the seam (N,) at a position that every robot reaches."""
    placement = job.placement(measure.reading())
    found = placement.measures(solved(job, tuple(position)))
    return Measures(*(values[0] for values in found))
