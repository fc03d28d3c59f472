"""Ground truth for a search in a box: a dense grid, its best cells refined by a pattern search."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np

from ..arguments import LATER, MOST, Count, Positive, Shape, checked
from ..errors import InputError
from .genetic import Fitness, checked_box, rated

_SHRINK = 0.5
#: Values that differ by no more, relative, are equal: round-off must not choose between them.
TIE = 1e-12


class Optimum(NamedTuple):
    """A position, its fitness (0: nothing feasible was found) and the evaluations spent."""

    position: np.ndarray
    fitness: float
    evaluations: int


def grid_points(box: np.ndarray, spacing: float) -> np.ndarray:
    """Points (P, n) of a grid over the box, at most ``spacing`` apart along each axis."""
    box = checked_box(box)
    sides = (box[:, 1] - box[:, 0]) / spacing + 1.0 if spacing > 0 else np.array([np.inf])
    if not np.prod(sides) <= MOST:
        raise InputError(
            "grid", "spacing", spacing, f"a length [m] that gives at most {MOST} points"
        )
    axes = [np.linspace(a, b, int(np.ceil((b - a) / spacing - 1e-9)) + 1) for a, b in box]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(box))


def ranked(positions: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Rows (P,) by value, largest first; rows that tie with the one before, by position.

    A symmetric job has mirror images of one value, which differ by the round-off of a processor.

    Parameters
    ----------
    positions : ndarray (P, n)
        Compared by their first coordinate, then by the next.
    values : ndarray (P,)
        Equal if within :data:`TIE`.
    """
    order = np.argsort(-values, kind="stable")
    sizes = values[order]
    lower = sizes[:-1] - sizes[1:] > TIE * np.abs(sizes[:-1])
    level = np.concatenate([[0], np.cumsum(lower)])[: len(order)]
    return order[np.lexsort((*positions[order].T[::-1], level))]


def best_cells(points: np.ndarray, values: np.ndarray, count: int, apart: float) -> np.ndarray:
    """Up to ``count`` points of positive value, as :func:`ranked`, no two nearer than ``apart``."""
    chosen: list[np.ndarray] = []
    for k in ranked(points, values):
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
    Neighbours that tie are :func:`ranked`, and one that ties with the position is not better.
    """
    box = checked_box(box)
    position = np.clip(np.asarray(start, dtype=float), *box.T)
    value, evaluations = float(rated(fitness, position[np.newaxis])[0]), 1
    directions = np.concatenate([np.eye(len(box)), -np.eye(len(box))])
    while step > tolerance:
        polled = np.clip(position + step * directions, *box.T)
        values = rated(fitness, polled)
        evaluations += len(polled)
        best = ranked(polled, values)[0]
        if values[best] - value > TIE * abs(value):
            position, value = polled[best], float(values[best])
        else:
            step *= _SHRINK
    return Optimum(position, value, evaluations)


def refined(
    fitness: Fitness, starts: np.ndarray, box: np.ndarray, step: float, tolerance: float
) -> Optimum:
    """The best end, as :func:`ranked`, of a pattern search from each start; NaN without a start."""
    if not len(starts):
        return Optimum(np.full(len(box), np.nan), 0.0, 0)
    ends = [pattern_search(fitness, start, box, step, tolerance) for start in starts]
    values = np.array([end.fitness for end in ends])
    best = ends[ranked(np.array([end.position for end in ends]), values)[0]]
    return best._replace(evaluations=sum(end.evaluations for end in ends))


@checked
def grid_optimum(
    fitness: Fitness,
    box: Annotated[np.ndarray, LATER],
    spacing: Positive,
    starts: Count = 8,
    tolerance: Positive = 1e-5,
    values: Annotated[np.ndarray, Shape("P")] | None = None,
) -> Optimum:
    """Best point of a grid after refinement of its best cells.

    Parameters
    ----------
    spacing : float
        Of the grid; also the least distance of the refined cells.
    starts : int
        How many cells are refined.
    tolerance : float
        Smallest step of the refinement.
    values : ndarray (P,), optional
        Fitness of the :func:`grid_points`, where it is known already; not counted then.

    Returns
    -------
    Optimum
        Its position is NaN where no point of the grid is of positive fitness.

    Raises
    ------
    InputError
        See :func:`.genetic.evolve`; another number of values than the grid has points.
    """
    box = checked_box(box)
    points, spent = grid_points(box, spacing), 0
    if values is None:
        values, spent = rated(fitness, points), len(points)
    elif len(values) != len(points):
        raise InputError("grid_optimum", "length of values", len(values), f"{len(points)}")
    cells = best_cells(points, values, starts, spacing)
    end = refined(fitness, cells, box, 0.5 * spacing, tolerance)
    return end._replace(evaluations=end.evaluations + spent)
