"""The landscape of a placement: fitness on horizontal planes, the height on a slider."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from ..page import Page
from .maps import Layer, map_slice


def placement_slice(
    title: str,
    fitness: Callable[[np.ndarray], np.ndarray],
    box: ArrayLike,
    optimum: ArrayLike,
    printed: ArrayLike,
    *,
    steps: int = 31,
    heights: int = 9,
    quantity: str = "fitness",
) -> Page:
    """Fitness over x and y at several heights; the plane of the optimum is shown first.

    Parameters
    ----------
    fitness
        Positions (N, 3) [m] to their fitness (N,), at most zero where none is feasible.
    box : (3, 2)
        Limits of x, y and z [m].
    optimum, printed : (3,)
        Marked on the plane nearest to each [m].
    """
    limits, best, said = (np.asarray(value, dtype=float) for value in (box, optimum, printed))
    x, y = (np.linspace(limits[k, 0], limits[k, 1], steps) for k in (0, 1))
    z = np.unique(np.append(np.linspace(limits[2, 0], limits[2, 1], heights), best[2]))
    points = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1)  # x, y, z
    values = np.asarray(fitness(points.reshape(-1, 3)), dtype=float).reshape(steps, steps, len(z))
    values = np.where(values > 0.0, values, np.nan)
    layers = []
    for k, height in enumerate(z):
        marks = {
            name: (float(place[0]), float(place[1]))
            for name, place in (("optimum", best), ("printed", said))
            if k == int(np.abs(z - place[2]).argmin())
        }
        layers.append(Layer(f"z = {height:.3f} m", values[:, :, k].T, marks))
    return map_slice(
        title,
        ("x [m]", x),
        ("y [m]", y),
        layers,
        quantity=quantity,
        shown=int(np.abs(z - best[2]).argmin()),
        ordered=True,
        value_range=(0.0, float(np.nanmax(values)) if np.isfinite(values).any() else 1.0),
        nothing="not feasible",
    )
