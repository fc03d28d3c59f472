"""Two arms at the moment when they are nearest, seen from where the gap shows best."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np

from .labels import name_points
from .style import BLACK, MASTER, SLAVE, name_axes, same_scale

_ELEVATIONS, _AZIMUTHS = (15, 30, 45, 60), range(-180, 180, 20)


def crossing_axes(axes: Sequence[Any], postures: Sequence[Sequence[np.ndarray]]) -> None:
    """Draw skeletons (K, 3) of two arms and paths of their tips into 3-D axes, all seen alike.

    The arms are as thick as links; the line joins the points of the skeletons that are nearest.
    """
    elev, azim = _view(*postures[0][:2])
    for ax, (left, right, *paths) in zip(axes, postures, strict=True):
        ax.computed_zorder = False
        for points, path, color in zip((left, right), paths, (MASTER, SLAVE), strict=True):
            ax.plot(*points.T, color=color, lw=10, alpha=0.3, zorder=1)
            ax.plot(*points.T, "o-", color=color, lw=2, ms=4, zorder=2)
            ax.plot(*points[-1:].T, "s", color=color, ms=7, zorder=3)
            ax.plot(*path.T, color=color, lw=1, zorder=1)
        near = np.array(nearest(left, right))
        ax.plot(*near.T, "o-", color=BLACK, lw=2.4, ms=5, zorder=4)
        name_axes(ax)
        ax.view_init(elev=elev, azim=azim)
        same_scale(ax, zoom=1.25)
        name_points(ax, {"left": left[0], "right": right[0]}, offset=(0, -12))


def nearest(one: np.ndarray, other: np.ndarray, steps: int = 41) -> tuple[np.ndarray, np.ndarray]:
    """Points of two polylines that are nearest, to a fortieth of a side."""
    share = np.linspace(0.0, 1.0, steps)[:, np.newaxis, np.newaxis]
    dense = [((1 - share) * line[:-1] + share * line[1:]).reshape(-1, 3) for line in (one, other)]
    distance = np.linalg.norm(dense[0][:, np.newaxis] - dense[1], axis=2)
    i, j = np.unravel_index(distance.argmin(), distance.shape)
    return dense[0][i], dense[1][j]


def _view(left: np.ndarray, right: np.ndarray) -> tuple[float, float]:
    """Elevation and azimuth [deg] from which the arms are spread and cross at the largest angle."""
    points = np.vstack([left, right])
    centred = points - points.mean(axis=0)

    def spread(view: tuple[int, int]) -> float:
        elev, azim = np.radians(view)
        towards = np.array([np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)])
        flat = centred - np.outer(centred @ towards, towards)
        values = np.linalg.svd(flat, compute_uv=False)
        return float(values[1])

    return max(product(_ELEVATIONS, _AZIMUTHS), key=spread)
