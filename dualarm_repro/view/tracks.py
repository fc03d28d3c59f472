"""Tracks of end effectors past boxes, in space and from two sides, and distances along them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any, NamedTuple, Unpack

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from scipy.spatial import ConvexHull

from ..scene import Box
from .labels import name_ends, name_points
from .link_bodies import Body, draw_flat, draw_in_space
from .style import (
    BLACK,
    ORANGE,
    PURPLE,
    RED,
    WIDTH,
    View,
    house_style,
    name_axes,
    same_scale,
)
from .window import nearest_to_boxes, opening

_CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))
_FACES = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))
_EVERY = 20  # steps between two dots on a track
_AROUND = 0.35  # kept free around the boxes in a view from a side [m]
_VIEWS = {"from above": (0, 1), "along x": (1, 2)}


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
    bodies: Sequence[Body] = (),
    **view: Unpack[View],
) -> Any:
    """Bars, tracks and named points in space and from two sides; circles where something is hit.

    Of the tracks the part within ``near`` of the middle of the named points is drawn [m]. Dots mark
    equal times, and a line the way from a track to the nearest bar. Arms are drawn as ``bodies`` at
    some instants, whose numbers stand at all tracks.
    """
    middle = np.mean(list(marks.values()), axis=0)
    with house_style():
        figure = plt.figure(figsize=(WIDTH, 5.2))
        grid = figure.add_gridspec(2, 2, width_ratios=(1.2, 1.0))
        space = figure.add_subplot(grid[:, 0], projection="3d", computed_zorder=False)
        name_axes(space)
        space.view_init(**({"elev": 22, "azim": -60} | view))
        for box in bars:
            corners = _corners(box)
            faces = [corners[list(face)] for face in _FACES]
            space.add_collection3d(
                Poly3DCollection(faces, facecolor="0.75", edgecolor="0.5", lw=0.4, alpha=0.5)
            )
        for track in tracks:
            shown = track.points[np.linalg.norm(track.points - middle, axis=1) <= near]
            space.plot(*shown.T, track.style, color=track.color, lw=2, label=track.name, zorder=3)
        _marks(space, marks, contacts or {}, size=45)
        for body in bodies:
            draw_in_space(space, body)
        same_scale(space, zoom=1.1)
        floor = space.get_zlim()[0]
        _shadows(space, tracks, middle, near, floor)
        for point in marks.values():
            foot = np.array([*point[:2], floor])
            space.plot(*np.array([point, foot]).T, ":", color="0.5", lw=0.9, zorder=2)
            space.plot(*foot, "x", color="0.5", ms=4, zorder=2)
        space.set_zlim(floor, space.get_zlim()[1])
        sides = [figure.add_subplot(grid[row, 1]) for row in range(len(_VIEWS))]
        told = [_side(ax, name, bars, tracks, marks, contacts or {}, bodies)
                for ax, name in zip(sides, _VIEWS, strict=True)]  # fmt: skip
        if tracks:
            figure.legend(handles=_handles(tracks), loc="outside upper left", ncols=4)
        for ax, names in zip((space, *sides), ({**marks, **(contacts or {})}, *told), strict=True):
            name_points(ax, names)
    return figure


def _shadows(
    space: Any, tracks: Sequence[Track], middle: np.ndarray, near: float, floor: float
) -> None:
    """Shadows of the tracks on the floor of a drawing in space, so that depth can be read."""
    for track in tracks:
        shown = track.points[np.linalg.norm(track.points - middle, axis=1) <= near]
        ground = np.full(len(shown), floor)
        space.plot(*shown[:, :2].T, ground, color=track.color, lw=1.2, alpha=0.3, zorder=0)


def top_view_figure(
    bars: Sequence[Box],
    tracks: Sequence[Track],
    marks: Mapping[str, np.ndarray],
    bodies: Sequence[Body] = (),
) -> Any:
    """Bars, tracks, named points and arms around the bars, seen along -z."""
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 5.4))
        told = _side(ax, "from above", bars, tracks, marks, {}, bodies)
        figure.legend(handles=_handles(tracks), loc="outside upper left", ncols=4)
        name_points(ax, told)
    return figure


def distances_figure(
    curves: Mapping[str, np.ndarray], lines: Mapping[str, float], steps: np.ndarray | None = None
) -> Any:
    """Distances over the steps of a motion, with named levels as dashed lines."""
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 3.6))
        for name, values in curves.items():
            ax.plot(np.arange(len(values)) if steps is None else steps, values, lw=2, label=name)
        for (name, level), color in zip(lines.items(), (BLACK, PURPLE, ORANGE), strict=False):
            ax.axhline(level, color=color, ls="--", lw=1, label=name)
        ax.set(xlabel="step", ylabel="distance [m]")
        ax.margins(x=0)
        name_ends(ax)
    return figure


def _handles(tracks: Sequence[Track]) -> list[Any]:
    dots = plt.Line2D([], [], color="0.3", ls="none", marker="o", ms=3.5,
                      label=f"every {_EVERY} steps")  # fmt: skip
    return [
        *(plt.Line2D([], [], color=t.color, ls=t.style, lw=2, label=t.name) for t in tracks), dots
    ]  # fmt: skip


def _side(
    ax: Any,
    name: str,
    bars: Sequence[Box],
    tracks: Sequence[Track],
    marks: Mapping[str, np.ndarray],
    contacts: Mapping[str, np.ndarray],
    bodies: Sequence[Body] = (),
) -> dict[str, np.ndarray]:
    """What happens around the bars, seen from one side; what is to be named there."""
    pair = list(_VIEWS[name])
    corners = np.vstack([_corners(box)[:, pair] for box in bars])
    inner = [point[pair] for point in marks.values() if _close(point[pair], corners)]
    frame = np.vstack([corners, *inner])
    low, high = frame.min(axis=0) - _AROUND, frame.max(axis=0) + _AROUND
    lack = (0.7 * (high - low).max() - (high - low)).clip(0.0)
    low, high = low - 0.5 * lack, high + 0.5 * lack
    for box in bars:
        flat = _corners(box)[:, pair]
        outline = flat[ConvexHull(flat).vertices]
        ax.fill(*outline.T, facecolor="0.8", edgecolor="0.5", lw=0.6, zorder=1, alpha=0.6)
    for track in tracks:
        points = track.points[:, pair]
        ax.plot(*points.T, track.style, color=track.color, lw=1.8, zorder=3, label=track.name)
        ax.plot(*points[::_EVERY].T, "o", color=track.color, ms=3.5, zorder=4)
    _marks(ax, {n: p[pair] for n, p in marks.items()}, {n: p[pair] for n, p in contacts.items()},
           size=35)  # fmt: skip
    ax.set(xlabel=f"{'xyz'[pair[0]]} [m]", ylabel=f"{'xyz'[pair[1]]} [m]", aspect="equal",
           xlim=(low[0], high[0]), ylim=(low[1], high[1]))  # fmt: skip
    ax.set_title(name)
    for body in bodies:
        draw_flat(ax, body, pair)
    # Seen along x the points lie close together; their signs are explained from above.
    told = {**marks, **contacts} if name == "from above" else {}
    named = {n: p[pair] for n, p in told.items()}
    named = {n: p for n, p in named.items() if (p > low).all() and (p < high).all()}
    gaps = {} if contacts else _gaps(ax, bars, tracks, pair)
    size = _opening(ax, bars) if pair == [1, 2] and not contacts else {}
    times = _times(ax, tracks, bodies, pair) if name == "from above" else {}
    inside = {n: p for n, p in times.items() if (p > low).all() and (p < high).all()}
    times = {} if contacts else inside  # which say themselves when they happen
    return {**named, **gaps, **size, **times}


def _times(
    ax: Any, tracks: Sequence[Track], bodies: Sequence[Body], pair: list[int]
) -> dict[str, np.ndarray]:
    """Where the tracks are at the instants of the bodies, ringed; what is to be named there."""
    found = {}
    for step in dict.fromkeys(body.step for body in bodies):
        for k, track in enumerate(tracks):
            if track.style == ":":
                continue
            at = track.points[min(step, len(track.points) - 1), pair]
            ax.plot(*at, "o", mfc="white", mec=track.color, mew=1.6, ms=6.5, zorder=5)
            found[f"{step}" + " " * k] = at
    return found


def _close(point: np.ndarray, corners: np.ndarray) -> bool:
    span = corners.max(axis=0) - corners.min(axis=0)
    return bool((np.abs(point - corners.mean(axis=0)) < 0.5 * span + 1.2).all())


def _gaps(
    ax: Any, bars: Sequence[Box], tracks: Sequence[Track], pair: list[int]
) -> dict[str, np.ndarray]:
    """Lines from each full track to the nearest bar; their lengths and where to name them."""
    found = {}
    for track in tracks:
        if track.style == "-":
            a, b = nearest_to_boxes(track.points, bars)
            ax.plot(*np.array([a, b])[:, pair].T, color=BLACK, lw=1.1, zorder=6)
            name = f"{np.linalg.norm(a - b):.2f} m"
            found[name] = 0.5 * (a + b)[pair]
    return found


def _opening(ax: Any, bars: Sequence[Box]) -> dict[str, np.ndarray]:
    """Width and height of the opening as dimension lines seen along x; where to name them."""
    free = opening(bars)
    if free is None:
        return {}
    (y0, z0), (y1, z1) = free
    arrow = {"arrowstyle": "<->", "color": "0.3", "lw": 1, "shrinkA": 0, "shrinkB": 0}
    across, up = z0 + 0.12 * (z1 - z0), y1 - 0.12 * (y1 - y0)
    ax.annotate("", (y0, across), (y1, across), arrowprops=arrow)
    ax.annotate("", (up, z0), (up, z1), arrowprops=arrow)
    return {
        f"{y1 - y0:.2f} m": np.array([y0 + 0.3 * (y1 - y0), across]),
        f"{z1 - z0:.2f} m ": np.array([up, z0 + 0.6 * (z1 - z0)]),
    }


def _marks(
    ax: Any, marks: Mapping[str, np.ndarray], contacts: Mapping[str, np.ndarray], size: float
) -> None:
    flat = {"depthshade": False} if ax.name == "3d" else {}
    for point, sign in zip(marks.values(), "o^*sD", strict=False):
        ax.scatter(*point, marker=sign, s=size, color=BLACK, zorder=5, **flat)
    for point, edge in zip(contacts.values(), (RED, PURPLE), strict=False):
        ax.scatter(*point, marker="o", s=5 * size, facecolors="none", edgecolors=edge, lw=2,
                   zorder=6, **flat)  # fmt: skip


def _corners(box: Box) -> np.ndarray:
    return box.center + (_CORNERS * box.half) @ box.rotation.T
