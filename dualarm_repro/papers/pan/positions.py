"""The job at named positions: at the optimum obtained, at the printed one, at two poor ones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...tracking import memo
from ...view.scene3d import Scene3D
from ...view.welding_scene import job_scene
from ...welding import WELDER, Cell, Jobs, Measures, Optimum, Status
from ...welding.grid_search import best_cells, grid_points, refined
from .optimum import SPACING, STARTS, Box, measures_at, optimum, solved
from .scenario import Job, Measure

#: Largest manipulability of the bars in the scenes [m^3].
FULL_SCALE = 0.7
#: Rule to a score (P,) from manipulabilities (P, 3, N) and system measure (P, N).
_SCORES = {
    "lowest_welder": lambda w, system: 1.0 / w[:, WELDER].max(axis=1),
    "lowest_mean_of_welder": lambda w, system: 1.0 / w[:, WELDER].mean(axis=1),
    "largest_variation": lambda w, system: system.std(axis=1) / system.mean(axis=1),
    "largest_swing": lambda w, system: np.ptp(system, axis=1) / system.max(axis=1),
}


def search_box(assumed: Mapping[str, Any]) -> Box:
    """The declared region as a hashable value."""
    return tuple(tuple(side) for side in assumed["search_box"])


def found_optimum(assumed: Mapping[str, Any]) -> tuple[Job, Measure, Optimum]:
    """Job, measure and optimum of the assumptions."""
    job, measure = Job.of(assumed), Measure.of(assumed)
    return job, measure, optimum(job, measure, search_box(assumed))


def at_optimum(assumed: Mapping[str, Any]) -> tuple[Cell, Jobs, np.ndarray, Measures]:
    """The job at the optimum obtained: cell, joint paths, position, measures along the seam.

    Raises
    ------
    InputError
        No position of the region is feasible.
    """
    job, measure, best = found_optimum(assumed)
    centre = best.position
    return (
        job.cell(),
        solved(job, tuple(centre)),
        centre,
        measures_at(job, measure, centre),
    )


def job_scene_at(title: str, cell: Cell, jobs: Jobs, centre: np.ndarray) -> Scene3D:
    """The animation of the whole job at one position."""
    return job_scene(title, cell, jobs.q[0], centre, jobs.w[0], FULL_SCALE)


@memo(4096)
def extreme_position(job: Job, measure: Measure, box: Box, rule: str) -> Optimum:
    """Feasible position that a rule calls poor; NaN if no position of the grid is feasible.

    ``rule`` is ``lowest_welder`` (its largest manipulability along the seam is smallest),
    ``lowest_mean_of_welder``, ``largest_variation`` (coefficient of variation of the system
    measure) or ``largest_swing`` (its range over its maximum).
    """
    placement = job.placement(measure.reading())

    def score(points: np.ndarray) -> np.ndarray:
        jobs = placement.jobs(points)
        values = np.zeros(len(points))
        if jobs.feasible.any():
            part = jobs.select(jobs.feasible)
            values[jobs.feasible] = _SCORES[rule](part.w, placement.measures(part).system)
        return values

    points = grid_points(np.array(box), SPACING)
    values = np.concatenate([score(block) for block in np.array_split(points, 64)])
    cells = best_cells(points, values, STARTS, SPACING)
    return refined(score, cells, np.array(box), 0.5 * SPACING, 1e-3)


def status_name(jobs: Jobs) -> str:
    """Outcome of the constraints at the first position, in words."""
    return Status(int(jobs.status[0])).name.lower().replace("_", " ")
