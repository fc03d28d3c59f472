"""Drawings of two pipes and of the seam between them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from mpl_toolkits.mplot3d import proj3d
from scipy.spatial import cKDTree

from ..welding import Seam
from .labels import name_point, push_apart
from .style import BLACK, BLUE, ORANGE, PALETTE, RED, axes_3d, house_style, ink, same_scale

_FLAT = 0.25  # height by width of a curve that is drawn higher than it is


def pipes_figure(
    seam: Seam, radius_main: float, radius_branch: float, length: float, branch_length: float
) -> Any:
    """Main pipe along x, branch along z, and their seam, all in metres."""
    angle = np.linspace(0, 2 * np.pi, 49)
    along = np.linspace(-0.5 * length, 0.5 * length, 25)
    x, a = np.meshgrid(along, angle)
    top = np.sqrt(radius_main**2 - (radius_branch * np.sin(angle)) ** 2)
    share, b = np.meshgrid(np.linspace(0, 1, 9), angle)
    height = top[:, np.newaxis] * (1 - share) + share * (radius_main + branch_length)
    with house_style():
        figure, ax = axes_3d(6.8, 4.6, elev=28, azim=-55)
        for surface, color in (
            ((x, radius_main * np.cos(a), radius_main * np.sin(a)), BLUE),
            ((radius_branch * np.cos(b), radius_branch * np.sin(b), height), ORANGE),
        ):
            ax.plot_surface(*surface, color=color, alpha=0.4, lw=0, rasterized=True)
        ax.plot(*_closed(seam.points).T, color=RED, lw=2.5)
        same_scale(ax, zoom=1.1)
        top = np.array([0.0, 0.0, radius_main + branch_length])
        named = {"main pipe": np.array([0.35 * length, 0.0, radius_main]), "branch": top,
                 "seam": seam.points[int(seam.points[:, 1].argmin())]}  # fmt: skip
        texts = [name_point(ax, at, name, (0, 9)) for name, at in named.items()]
        texts[-1].set_color(ink(RED))
        push_apart(figure, texts)
    return figure


def seam_figure(
    curves: Mapping[str, np.ndarray], marked: Mapping[str, np.ndarray] | None = None
) -> Any:
    """Closed space curves (N, 3) in metres, one for each name; a dot where each begins.

    What is flatter than a quarter of its width is drawn higher than it is, and says so. Points (3,)
    that are ``marked`` get a cross and their name.
    """
    spans = np.ptp(np.vstack(list(curves.values())), axis=0)
    flat = spans[2] / spans[:2].max()
    stretch = 1.0 if flat > _FLAT else float(max(2, round(0.5 / flat)))
    with house_style():
        figure, ax = axes_3d(6.6, 4.2, elev=24, azim=-55)
        for color, (name, curve) in zip(PALETTE[::3], curves.items(), strict=False):
            ax.plot(*_closed(curve).T, color=color, label=name, lw=2)
            ax.scatter(*curve[:1].T, color=color, s=30, depthshade=False)
        if stretch > 1:
            ax.set_title(f"z drawn {stretch:.0f} times larger")
        same_scale(ax, stretch=stretch)
        texts = [
            _name_outside(ax, curve, [] if k else list(curves.values())[1:], name, color)
            for k, (color, (name, curve)) in enumerate(
                zip(PALETTE[::3], curves.items(), strict=False)
            )
        ]
        for name, point in (marked or {}).items():
            ax.scatter(*point, color=BLACK, marker="x", s=36, depthshade=False)
            inside = list(curves.values())[-1].mean(axis=0)
            to, at = (proj3d.proj_transform(*p, ax.get_proj())[0] for p in (inside, point))
            texts.append(name_point(ax, point, name, (42 * np.sign(to - at), -7)))
        push_apart(figure, texts)
    return figure


def _name_outside(
    ax: Any, curve: np.ndarray, others: list[np.ndarray], name: str, color: str
) -> Any:
    """Name a curve above its upper side on the paper, far from the other curves."""
    at, *rest = (np.array(proj3d.proj_transform(*c.T, ax.get_proj())[:2]).T
                 for c in (curve, *others))  # fmt: skip
    middle = at.mean(axis=0)
    merit = at[:, 1] - middle[1] - 0.7 * abs(at[:, 0] - middle[0])
    if rest:
        merit += 6.0 * cKDTree(np.vstack(rest)).query(at)[0]
    return name_point(ax, curve[int(merit.argmax())], name, (0, 14), color=color)


def _closed(points: np.ndarray) -> np.ndarray:
    return np.vstack([points, points[:1]])
