"""Two arms at the moment when they are nearest, as bodies, seen from where the gap shows best."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from .arm_drawings import skeleton
from .labels import name_points
from .link_bodies import Body, capsules_at, draw_in_space
from .style import BLACK, name_axes, same_scale

_ELEVATIONS, _AZIMUTHS = (10, 25, 40, 55), range(-180, 180, 15)


class Crossing(NamedTuple):
    """Bodies of two arms, the paths (N, 3) of their tips, and the nearest points (2, 3) [m]."""

    bodies: tuple[Body, Body]
    paths: tuple[np.ndarray, np.ndarray]
    nearest: np.ndarray


def crossing_axes(axes: Sequence[Any], crossings: Sequence[Crossing]) -> None:
    """Draw arms with the capsules that are kept apart into 3-D axes, all seen alike.

    The black line joins the nearest points of both arms, within the links where these overlap.
    """
    elev, azim = _view(crossings[0])
    for ax, crossing in zip(axes, crossings, strict=True):
        ax.computed_zorder = False
        named = {}
        for body, path in zip(crossing.bodies, crossing.paths, strict=True):
            draw_in_space(ax, body, alpha=0.16)
            points = skeleton(body.placed.arm, body.q, body.placed.placement)
            ax.plot(*points.T, "o-", color=body.color, lw=2, ms=3, zorder=2)
            ax.plot(*path.T, color=body.color, lw=1.2, zorder=1)
            named[body.placed.name] = points[0]
        ax.plot(*crossing.nearest.T, "o-", color=BLACK, lw=2.6, ms=5, zorder=4)
        name_axes(ax)
        ax.view_init(elev=elev, azim=azim)
        same_scale(ax, zoom=1.25)
        name_points(ax, named, offset=(-24, -4))


def _view(crossing: Crossing) -> tuple[float, float]:
    """Elevation and azimuth [deg] that show the line between the nearest points at its length and
    the arms spread."""
    points = np.concatenate([capsules_at(body)[0].reshape(-1, 3) for body in crossing.bodies])
    centred, gap = points - points.mean(axis=0), np.diff(crossing.nearest, axis=0)[0]

    def score(view: tuple[int, int]) -> float:
        elev, azim = np.radians(view)
        towards = np.array([np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)])
        flat = centred - np.outer(centred @ towards, towards)
        across = np.linalg.norm(gap - (gap @ towards) * towards) / np.linalg.norm(gap)
        return float(np.linalg.svd(flat, compute_uv=False)[1] * across**2)

    return max(product(_ELEVATIONS, _AZIMUTHS), key=score)
