"""Flange paths and stick figures of arms among spheres."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import cycle
from typing import Any, Unpack

import matplotlib.pyplot as plt
import numpy as np

from ..scene import PlacedArm, Sphere
from .arm_drawings import skeleton
from .labels import name_point, push_apart
from .style import (
    BLACK,
    ORANGE,
    PALETTE,
    WIDTH,
    View,
    axes_3d,
    house_style,
    same_scale,
)

#: Colours of paths; that of the spheres is left out.
_COLORS = (PALETTE[0], PALETTE[3], PALETTE[2], PALETTE[4])
#: Where names stand from marked points, in points of a letter, and the line between.
_AWAY = ((0, -20), (-22, 30), (44, 20), (-31, -14))
_LINE = {"arrowstyle": "-", "color": "0.4", "lw": 0.7, "shrinkA": 0, "shrinkB": 3}


@dataclass(frozen=True, eq=False)
class TipPanel:
    """One panel: flange paths (N, 3) by label, postures drawn as stick figures, marked points."""

    title: str
    paths: Mapping[str, np.ndarray]
    postures: Sequence[tuple[PlacedArm, np.ndarray]] = ()
    marks: Mapping[str, np.ndarray] = field(default_factory=dict)


def tip_path_figure(
    panels: Sequence[TipPanel], spheres: Sequence[Sphere], **view: Unpack[View]
) -> Any:
    """Panels side by side, each with the spheres and the floor's height as lower end of z.

    A ring marks where each path begins and a square where it ends; postures of an arm become
    darker in their order, and those of several arms at common times carry the number of the time.
    """
    with house_style():
        wide = WIDTH if len(panels) > 1 else 0.75 * WIDTH
        figure, axes = axes_3d(wide, 4.6, columns=len(panels), **view)
        handles: dict[str, Any] = {}
        for ax, panel in zip(np.atleast_1d(axes), panels, strict=True):
            ax.computed_zorder = False
            for sphere in spheres:
                draw_sphere(ax, sphere)
            _postures(ax, panel)
            for color, (name, points) in zip(_COLORS, panel.paths.items(), strict=False):
                (handles[name],) = ax.plot(*points.T, "-", color=color, lw=2, zorder=4)
                ax.plot(*points[:1].T, "o", color=color, mfc="white", mew=1.6, ms=6, zorder=5)
                ax.plot(*points[-1:].T, "s", color=color, ms=6, zorder=5)
            for marker, point in zip("xPD*", panel.marks.values(), strict=False):
                ax.plot(*np.atleast_2d(point).T, marker, color=BLACK, ms=8, ls="none", zorder=6)
            _keep_wide(ax)
            ax.set_title(panel.title, pad=22)  # above names that stand over the arm
            same_scale(ax, zoom=1.05)
        if handles:
            handles["path begins"] = _sign("o", mfc="white", mew=1.6)
            handles["path ends"] = _sign("s")
        if any(map(_numbered, panels)):
            handles["times in order"] = _sign("$1$", mew=0.4, ms=7)
        if spheres:
            handles["obstacles"] = _sign("o", color=ORANGE, alpha=0.5, ms=10)
        if len(handles) > 1:
            figure.legend(handles.values(), handles, loc="outside upper left", ncols=len(handles))
        for ax, panel in zip(np.atleast_1d(axes), panels, strict=True):
            _name(ax, panel)
    return figure


def _name(ax: Any, panel: TipPanel) -> None:
    """Names of marked points, the first of several of one name for all, and numbers of times."""
    texts = [
        name_point(ax, np.atleast_2d(point)[0], name, away, arrowprops=_LINE)
        for away, (name, point) in zip(cycle(_AWAY), panel.marks.items(), strict=False)
    ]
    for color, own in _by_arm(panel) if _numbered(panel) else ():
        for k, (placed, q) in enumerate(own, 1):
            flange = skeleton(placed.arm, q, placed.placement)[-1]
            texts.append(name_point(ax, flange, str(k), (0, 11), color=color))
    push_apart(ax.figure, texts)


def _numbered(panel: TipPanel) -> bool:
    """Whether postures of several arms share their times."""
    return len({placed.name for placed, _ in panel.postures}) > 1


def _by_arm(panel: TipPanel) -> list[tuple[str, list[tuple[PlacedArm, np.ndarray]]]]:
    """Postures of each arm with its colour: grey for one arm, else in the colours of the paths."""
    names = list(dict.fromkeys(placed.name for placed, _ in panel.postures))
    colors = _COLORS if len(names) > 1 else ("0.25",)
    return [
        (color, [(placed, q) for placed, q in panel.postures if placed.name == name])
        for name, color in zip(names, colors, strict=False)
    ]


def _postures(ax: Any, panel: TipPanel) -> None:
    """Stick figures, darker in their order."""
    for color, own in _by_arm(panel):
        for k, (placed, q) in enumerate(own):
            shade = 0.25 + 0.6 * k / max(len(own) - 1, 1)
            points = skeleton(placed.arm, q, placed.placement)
            ax.plot(*points.T, color=color, lw=2.2, alpha=shade, zorder=3)
            ax.plot(*points[:1].T, "s", color=color, ms=6, zorder=3)


def _sign(marker: str, **how: Any) -> Any:
    style: dict[str, Any] = {"color": "0.3", "ms": 6} | how
    return plt.Line2D([], [], ls="none", marker=marker, **style)


def _keep_wide(ax: Any, least: float = 0.4) -> None:
    """No axis of a drawing in one plane collapses."""
    for limits, widen in ((ax.get_xlim(), ax.set_xlim), (ax.get_ylim(), ax.set_ylim)):
        middle, half = 0.5 * sum(limits), 0.5 * max(limits[1] - limits[0], least)
        widen(middle - half, middle + half)


def draw_sphere(ax: Any, sphere: Sphere) -> None:
    """A sphere as a faint surface."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 24), np.linspace(0, np.pi, 13))
    shell = np.array([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)])
    x, y, z = sphere.center[:, None, None] + sphere.radius * shell
    ax.plot_surface(x, y, z, color=ORANGE, alpha=0.3, linewidth=0, rasterized=True)
