"""Ground truth for a search in a box: a dense grid, its best cells refined by a pattern search."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .genetic import Fitness, checked_box

_SHRINK = 0.5


class Optimum(NamedTuple):
    """A position, its fitness (0: nothing feasible was found) and the evaluations spent."""

    position: np.ndarray
    fitness: float
    evaluations: int


def grid_points(box: np.ndarray, spacing: float) -> np.ndarray:
    """Points (P, n) of a grid over the box, at most ``spacing`` apart along each axis."""
    box = checked_box(box)
    axes = [np.linspace(a, b, int(np.ceil((b - a) / spacing - 1e-9)) + 1) for a, b in box]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(box))


def best_cells(points: np.ndarray, values: np.ndarray, count: int, apart: float) -> np.ndarray:
    """Up to ``count`` points of positive value, best first, no two nearer than ``apart``."""
    chosen: list[np.ndarray] = []
    for k in np.argsort(-values, kind="stable"):
        if values[k] <= 0 or len(chosen) == count:
            break
        if all(np.linalg.norm(points[k] - other) >= apart for other in chosen):
            chosen.append(points[k])
    return np.array(chosen).reshape(-1, points.shape[1])


def pattern_search(
    fitness: Fitness, start: np.ndarray, box: np.ndarray, step: float, tolerance: float
) -> Optimum:
    """Move to the best of the 2n neighbours at +-step along the axes, or halve the step.

    R. Hooke and T. A. Jeeves, Direct search solution of numerical and statistical problems, J. ACM
    8(2), 1961, in its plain form with a full poll. Ends when the step falls below ``tolerance``.
    """
    box = checked_box(box)
    position = np.clip(np.asarray(start, dtype=float), *box.T)
    value, evaluations = float(fitness(position[np.newaxis])[0]), 1
    directions = np.concatenate([np.eye(len(box)), -np.eye(len(box))])
    while step > tolerance:
        polled = np.clip(position + step * directions, *box.T)
        values = fitness(polled)
        evaluations += len(polled)
        best = int(values.argmax())
        if values[best] > value:
            position, value = polled[best], float(values[best])
        else:
            step *= _SHRINK
    return Optimum(position, value, evaluations)


def refined(
    fitness: Fitness, starts: np.ndarray, box: np.ndarray, step: float, tolerance: float
) -> Optimum:
    """The best end of a pattern search from each start; position NaN if there is no start."""
    if not len(starts):
        return Optimum(np.full(len(box), np.nan), 0.0, 0)
    ends = [pattern_search(fitness, start, box, step, tolerance) for start in starts]
    best = max(ends, key=lambda end: end.fitness)
    return best._replace(evaluations=sum(end.evaluations for end in ends))


def grid_optimum(
    fitness: Fitness, box: np.ndarray, spacing: float, starts: int = 8, tolerance: float = 1e-5
) -> Optimum:
    """Best point of a grid after refinement of its best cells.

    Parameters
    ----------
    spacing : float
        Of the grid; also the least distance of the refined cells.
    starts : int
        How many cells are refined.
    """
    points = grid_points(box, spacing)
    values = fitness(points)
    end = refined(
        fitness, best_cells(points, values, starts, spacing), box, 0.5 * spacing, tolerance
    )
    return end._replace(evaluations=end.evaluations + len(points))
