"""Names that stand at what they name: at the ends of curves and at points, and apart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.patheffects import withStroke
from matplotlib.text import Text
from mpl_toolkits.mplot3d import proj3d

from .style import BLACK, ink

_GAP = 1.25  # between names at the ends of curves, in heights of a letter
_ROUNDS = 120  # of pushing names apart
_HALO = (withStroke(linewidth=2.5, foreground="white"),)


def name_ends(ax: Any, fontsize: float = 9.0) -> None:
    """Name each labelled curve at its right end, beyond the axes, in its colour; no legend needed.

    Names that would overlap are moved apart.
    """
    curves = [line for line in ax.get_lines() if not line.get_label().startswith("_")]
    figure = ax.figure
    texts = [
        ax.text(1.015, 0.5, line.get_label(), transform=ax.transAxes, va="center", ha="left",
                fontsize=fontsize, color=ink(line.get_color()))
        for line in curves
    ]  # fmt: skip
    figure.draw_without_rendering()
    ends = [_right_end(ax, line) for line in curves]
    step = _GAP * fontsize * figure.dpi / 72 / ax.bbox.height
    rows = [step * (1 + text.get_text().count("\n")) for text in texts]
    for text, height in zip(texts, _apart(np.array(ends), np.array(rows)), strict=True):
        text.set_y(height)


def _right_end(ax: Any, line: Any) -> float:
    """Height of the right end of a curve that can be seen, as a share of the axes."""
    x, y = line.get_xdata(orig=False), line.get_ydata(orig=False)
    transform = line.get_transform()
    points = transform.transform(np.column_stack([x, y]))
    at = ax.transAxes.inverted().transform(points[np.isfinite(points).all(axis=1)])
    seen = at[(at[:, 0] <= 1.001) & (at[:, 1] <= 1.001) & (at[:, 1] >= -0.001)]
    return float(np.clip((seen if len(seen) else at)[-1, 1], 0.0, 1.0))


def _apart(wanted: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Heights near the wanted ones, centres at least half of both rows apart, within 0..1."""
    order = np.argsort(wanted, kind="stable")
    places = wanted[order].astype(float)
    need = 0.5 * (rows[order][1:] + rows[order][:-1])
    for _ in range(_ROUNDS):
        short = need - np.diff(places)
        if not (short > 1e-9).any():
            break
        for k in np.flatnonzero(short > 1e-9):
            lack = need[k] - (places[k + 1] - places[k])
            if lack > 0:
                places[k] -= 0.5 * lack
                places[k + 1] += 0.5 * lack
    places += max(0.0, -places[0]) if len(places) else 0.0
    places -= max(0.0, places[-1] - 1.0) if len(places) else 0.0
    found = np.empty_like(places)
    found[order] = places
    return found


def name_point(
    ax: Any, point: np.ndarray, name: str, offset: tuple[float, float] = (7, 7), **how: Any
) -> Any:
    """Name a point (2,) or, in a 3-D drawing, (3,); ``offset`` in points of a letter."""
    at = np.asarray(point, dtype=float)
    if at.size == 3:
        at = np.array(proj3d.proj_transform(*at, ax.get_proj())[:2])
    style = {"color": BLACK, "fontsize": 9, "zorder": 20, "path_effects": _HALO} | how
    style["color"] = ink(style["color"])
    return ax.annotate(
        name, at, offset, textcoords="offset points", ha="center", va="center",
        annotation_clip=False, **style,
    )  # fmt: skip


def name_points(ax: Any, points: Mapping[str, np.ndarray], **how: Any) -> list[Any]:
    """Name points and move the names out of each other's way."""
    texts = [name_point(ax, point, name, **how) for name, point in points.items()]
    push_apart(ax.figure, texts)
    return texts


def push_apart(figure: Any, texts: Sequence[Any], room: float = 1.5) -> None:
    """Move annotations, ``room`` points around each, until no two overlap nor cover a point named.

    What is named stays where it is: only the offsets of the annotations change.
    """
    if not texts:
        return
    figure.draw_without_rendering()
    unit = 72 / figure.dpi
    sizes = np.array([_extent(text) for text in texts]) * unit + 2 * room
    anchors = np.array([_anchor(t) for t in texts]) * unit
    places = anchors + np.array([text.xyann for text in texts])
    fences = np.array([_fence(text) for text in texts]) * unit
    for _ in range(_ROUNDS):
        moved = _push(places, sizes, anchors)
        places = places.clip(fences[:, 0] + 0.5 * sizes, fences[:, 1] - 0.5 * sizes)
        if not moved:
            break
    for text, place, anchor in zip(texts, places, anchors, strict=True):
        text.xyann = tuple(place - anchor)


def _anchor(text: Any) -> np.ndarray:
    place = text.axes.transData if text.xycoords == "data" else text.xycoords
    return np.asarray(place.transform(text.xy))


def _fence(text: Any) -> np.ndarray:
    """Corners within which a name stays [px]: those of plane axes, so that it covers no number."""
    if text.axes.name == "3d":
        return np.array([[-1e6, -1e6], [1e6, 1e6]])
    return np.asarray(text.axes.bbox.get_points())


def _extent(text: Any) -> tuple[float, float]:
    box = Text.get_window_extent(text)  # without the line to what is named
    return box.width, box.height


def _push(places: np.ndarray, sizes: np.ndarray, anchors: np.ndarray) -> bool:
    """One round; whether anything moved."""
    moved = False
    for i in range(len(places)):
        for j in range(i):
            lack = 0.5 * (sizes[i] + sizes[j]) - np.abs(places[i] - places[j])
            if (lack > 1e-6).all():
                axis = int(np.argmin(lack))
                sign = 1.0 if places[i, axis] >= places[j, axis] else -1.0
                places[i, axis] += 0.51 * sign * lack[axis]
                places[j, axis] -= 0.51 * sign * lack[axis]
                moved = True
        for anchor in anchors:
            lack = 0.5 * sizes[i] + 3.0 - np.abs(places[i] - anchor)
            if (lack > 1e-6).all():
                axis = int(np.argmin(lack))
                places[i, axis] += (1.0 if places[i, axis] >= anchor[axis] else -1.0) * lack[axis]
                moved = True
    return moved
