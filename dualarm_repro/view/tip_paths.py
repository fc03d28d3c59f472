"""Flange paths and stick figures of arms among spheres."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Unpack

import numpy as np

from ..scene import PlacedArm, Sphere
from .arm_drawings import skeleton
from .style import BLACK, PALETTE, View, axes_3d, house_style


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
    """Panels side by side, each with the spheres and the floor's height as lower end of z."""
    with house_style():
        figure, axes = axes_3d(5.6 * len(panels), 5.0, columns=len(panels), **view)
        for ax, panel in zip(np.atleast_1d(axes), panels, strict=True):
            for sphere in spheres:
                draw_sphere(ax, sphere)
            for placed, q in panel.postures:
                ax.plot(*skeleton(placed.arm, q, placed.placement).T, color="0.6", lw=2, alpha=0.6)
            for color, (name, points) in zip(PALETTE, panel.paths.items(), strict=False):
                ax.plot(*points.T, ".-", color=color, ms=3, lw=1.4, label=name)
            for marker, (name, point) in zip("x*PD", panel.marks.items(), strict=False):
                points = np.atleast_2d(point)
                ax.plot(*points.T, marker, color=BLACK, ms=8, ls="none", label=name)
            _keep_wide(ax)
            ax.set_title(panel.title)
            ax.set_aspect("equal")
            ax.legend(loc="upper left", fontsize="small")
    return figure


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
    ax.plot_surface(x, y, z, color=PALETTE[1], alpha=0.3, linewidth=0)
