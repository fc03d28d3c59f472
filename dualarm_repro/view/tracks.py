"""Tracks of end effectors past boxes, in space and from above, and distances along them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any, NamedTuple, Unpack

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from scipy.spatial import ConvexHull

from ..scene import Box
from .style import BLACK, ORANGE, PURPLE, RED, View, axes_3d, house_style

_CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))
_FACES = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))


class Track(NamedTuple):
    """A polyline (N, 3) with its name, colour and line style."""

    name: str
    points: np.ndarray
    color: str
    style: str = "-"


def tracks_figure(
    bars: Sequence[Box],
    tracks: Sequence[Track],
    marks: Mapping[str, np.ndarray],
    contacts: Mapping[str, np.ndarray] | None = None,
    near: float = np.inf,
    **view: Unpack[View],
) -> Any:
    """Bars, tracks and named points in space; circles where something is hit.

    Of the tracks the part within ``near`` of the middle of the named points is drawn [m].
    """
    middle = np.mean(list(marks.values()), axis=0)
    with house_style():
        figure, ax = axes_3d(8.4, 5.6, **view)
        for box in bars:
            corners = _corners(box)
            faces = [corners[list(face)] for face in _FACES]
            ax.add_collection3d(
                Poly3DCollection(faces, facecolor="0.75", edgecolor="0.5", lw=0.4, alpha=0.5)
            )
        for track in tracks:
            shown = track.points[np.linalg.norm(track.points - middle, axis=1) <= near]
            ax.plot(*shown.T, track.style, color=track.color, lw=2, label=track.name)
        _marks(ax, marks, contacts or {}, size=70)
        ax.set_aspect("equal")
        figure.legend(*ax.get_legend_handles_labels(), loc="outside right upper", markerscale=0.6)
    return figure


def top_view_figure(
    bars: Sequence[Box], tracks: Sequence[Track], marks: Mapping[str, np.ndarray]
) -> Any:
    """Bars, tracks and named points seen along -z."""
    with house_style():
        figure, ax = plt.subplots(figsize=(6.4, 5.6))
        for box in bars:
            corners = _corners(box)[:, :2]
            outline = corners[ConvexHull(corners).vertices]
            ax.fill(*outline.T, facecolor="0.8", edgecolor="0.5", lw=0.6, zorder=1)
        for track in tracks:
            ax.plot(*track.points[:, :2].T, track.style, color=track.color, lw=2, label=track.name)
        _marks(ax, {name: point[:2] for name, point in marks.items()}, {}, size=50)
        ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
        ax.legend(loc="best")
    return figure


def distances_figure(
    curves: Mapping[str, np.ndarray], lines: Mapping[str, float], steps: np.ndarray | None = None
) -> Any:
    """Distances over the steps of a motion, with named levels as dashed lines."""
    with house_style():
        figure, ax = plt.subplots(figsize=(7.2, 3.8))
        for name, values in curves.items():
            ax.plot(np.arange(len(values)) if steps is None else steps, values, lw=2, label=name)
        for (name, level), color in zip(lines.items(), (BLACK, PURPLE, ORANGE), strict=False):
            ax.axhline(level, color=color, ls="--", lw=1, label=name)
        ax.set(xlabel="step", ylabel="distance [m]")
        ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def _marks(
    ax: Any, marks: Mapping[str, np.ndarray], contacts: Mapping[str, np.ndarray], size: float
) -> None:
    for (name, point), sign in zip(marks.items(), "o^*sD", strict=False):
        ax.scatter(*point, marker=sign, s=size, color=BLACK, zorder=5, label=name)
    for (name, point), edge in zip(contacts.items(), (RED, PURPLE), strict=False):
        ax.scatter(*point, marker="o", s=4 * size, facecolors="none", edgecolors=edge, lw=2,
                   zorder=6, label=name)  # fmt: skip


def _corners(box: Box) -> np.ndarray:
    return box.center + (_CORNERS * box.half) @ box.rotation.T
