"""Drawings of arms: dimensioned side view, link frames, stick figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, Unpack

import matplotlib.pyplot as plt
import numpy as np
import pinocchio as pin

from ..arms import Arm
from .labels import name_point, name_points, push_apart
from .style import BLACK, BLUE, GREEN, PALETTE, RED, View, axes_3d, house_style, same_scale

_AXIS_COLORS = (RED, GREEN, BLUE)
_PAPER = {"facecolor": "white", "edgecolor": "none", "pad": 1}
_PLATE = 0.12  # half side of the plate below a base, as a share of the reach


def dimension_drawing(
    outline: np.ndarray,
    dimensions: Sequence[tuple[str, np.ndarray, np.ndarray, tuple[float, float]]],
) -> Any:
    """Side view of an arm in its vertical plane with dimensions in millimetres.

    Parameters
    ----------
    outline
        Points (N, 2) of the skeleton, (x, z) in metres.
    dimensions
        Name, two end points (x, z) and the offset of the dimension line, metres.
    """
    with house_style():
        figure, ax = plt.subplots(figsize=(6.6, 5.6))
        ax.plot(*outline.T, color=BLUE, lw=5, alpha=0.55)
        ax.plot(*outline.T, "o", color=BLACK, ms=5)
        for name, start, end, offset in dimensions:
            a, b = np.asarray(start) + offset, np.asarray(end) + offset
            for foot, tip in ((start, a), (end, b)):
                ax.plot(*np.array([foot, tip]).T, color="0.6", lw=0.7)
            arrow = {"arrowstyle": "<->", "color": BLACK, "lw": 1, "shrinkA": 0, "shrinkB": 0}
            ax.annotate("", (a[0], a[1]), (b[0], b[1]), arrowprops=arrow)
            text = f"{name} = {1000 * float(np.linalg.norm(b - a)):.0f}"
            # Beyond the line, so that a short dimension keeps its arrow.
            x, z = 0.5 * (a + b) + 0.5 * np.asarray(offset)
            ax.text(x, z, text, ha="center", va="center", bbox=_PAPER)
        ax.set(xlabel="x [m]", ylabel="z [m]", aspect="equal", title="dimensions in mm")
        ax.margins(0.3, 0.12)
    return figure


def frames_figure(
    frames: np.ndarray,
    length: float,
    spans: Mapping[str, tuple[np.ndarray, np.ndarray]] | None = None,
) -> Any:
    """Frames 0, 1, ... (N, 4, 4) as triads on the skeleton of an arm.

    The skeleton follows the offsets along z and x of the tables. Axes that coincide share one label
    ("z0 z1"). Pieces of the skeleton may be named, as ``spans`` from point to point; every second
    one is darker, so that pieces in one line can be told apart.
    """
    axes: dict[tuple[float, ...], list[str]] = {}
    for number, frame in enumerate(frames):
        for axis, letter in enumerate("xyz"):
            tip = frame[:3, 3] + length * frame[:3, axis]
            axes.setdefault((*tip.round(6), *frame[:3, 3].round(6)), []).append(f"{letter}{number}")
    with house_style():
        figure, ax = axes_3d(6.8, 6.4, elev=20, azim=-52)
        ax.computed_zorder = False
        ax.plot(*_links(frames).T, "-", color="0.7", lw=5, zorder=1)
        for piece in list((spans or {}).values())[::2]:
            ax.plot(*np.array(piece).T, "-", color="0.45", lw=5, zorder=1.5, solid_capstyle="butt")
        ax.plot(*frames[:, :3, 3].T, "o", color="0.3", ms=6, zorder=2)
        named = []
        for place, names in axes.items():
            tip, origin = np.array(place[:3]), np.array(place[3:])
            color = _AXIS_COLORS["xyz".index(names[0][0])]
            ax.plot(*np.array([origin, tip]).T, color=color, lw=2, zorder=3)
            named.append((origin + 1.12 * (tip - origin), " ".join(names), color))
        middle = frames[:, 1, 3].mean()
        ax.set_ylim(middle - 2 * length, middle + 2 * length)
        same_scale(ax)
        texts = [name_point(ax, at, name, (0, 0), color=c, weight="bold") for at, name, c in named]
        texts += [
            name_point(ax, 0.5 * (a + b), name, (0, -14) if abs(b - a)[0] > 1e-6 else (-40, 0))
            for name, (a, b) in (spans or {}).items()
        ]
        push_apart(figure, texts, 0.5)
    return figure


def _links(frames: np.ndarray) -> np.ndarray:
    """The origins, with a corner where a link has an offset along z and one along x."""
    points = [frames[0, :3, 3]]
    for before, after in pairwise(frames):
        way = after[:3, 3] - before[:3, 3]
        for first, last in ((before[:3, 2], after[:3, 0]), (before[:3, 0], after[:3, 2])):
            corner = before[:3, 3] + (way @ first) * first
            if np.allclose(np.cross(after[:3, 3] - corner, last), 0.0, atol=1e-9):
                points.append(corner)
                break
        points.append(after[:3, 3])
    return np.array(points)


def stick_figure(arms: Mapping[str, tuple[Arm, np.ndarray, pin.SE3]], **view: Unpack[View]) -> Any:
    """Stick figure of arms: name to arm, configuration and placement of the base.

    Each stands on a plate; a dotted line leads from its flange to the height of the base.
    """
    with house_style():
        figure, ax = axes_3d(7.0, 4.6, **view)
        ax.computed_zorder = False
        named: dict[str, np.ndarray] = {}
        for color, (name, (arm, q, placement)) in zip(PALETTE[::3], arms.items(), strict=False):
            points = skeleton(arm, q, placement)
            half = _PLATE * np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
            draw_plate(ax, placement, float(half), color)
            ax.plot(*points.T, "-", color=color, lw=5, zorder=3)
            ax.plot(*points[:-1].T, "o", color="white", mec=color, mew=1.6, ms=6, zorder=4)
            ax.plot(*points[-1:].T, "s", color=color, ms=8, zorder=4)
            foot = np.array([*points[-1, :2], points[0, 2]])
            ax.plot(*np.array([points[-1], foot]).T, ":", color=color, lw=1, zorder=2)
            named[name] = points[0]
        same_scale(ax, zoom=1.1)
        name_points(ax, named, offset=(0, -16))
        ax.set_title("square: flange; plate: base")
    return figure


def draw_plate(ax: Any, placement: pin.SE3, half: float, color: str) -> None:
    """A square below a base."""
    corners = half * np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (-1, -1, 0)])
    corners = corners @ placement.rotation.T + placement.translation
    ax.plot(*corners.T, "-", color=color, lw=1.4, zorder=1)


def skeleton(arm: Arm, q: np.ndarray, placement: pin.SE3) -> np.ndarray:
    """Base, joint origins and flange in the world (nq + 2, 3) [m]."""
    points = np.vstack([np.zeros(3), arm.joint_positions(q)])
    return points @ placement.rotation.T + placement.translation
