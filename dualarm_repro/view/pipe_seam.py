"""Drawings of two pipes and of the seam between them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..welding import Seam
from .style import BLUE, ORANGE, PALETTE, RED, axes_3d, house_style


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
        figure, ax = axes_3d(6.8, 5.0, elev=28, azim=-55)
        ax.plot_surface(
            x, radius_main * np.cos(a), radius_main * np.sin(a), color=BLUE, alpha=0.35, lw=0
        )
        ax.plot_surface(
            radius_branch * np.cos(b),
            radius_branch * np.sin(b),
            height,
            color=ORANGE,
            alpha=0.45,
            lw=0,
        )
        ax.plot(*_closed(seam.points).T, color=RED, lw=2.5, label="seam")
        ax.legend(loc="upper left")
        ax.set_aspect("equal")
    return figure


def seam_figure(curves: Mapping[str, np.ndarray]) -> Any:
    """Closed space curves (N, 3) in metres, one for each name."""
    with house_style():
        figure, ax = axes_3d(6.2, 5.0, elev=24, azim=-55)
        for color, (name, points) in zip(PALETTE[::3], curves.items(), strict=False):
            ax.plot(*_closed(points).T, color=color, label=name)
            ax.scatter(*points[:1].T, color=color, s=30)
        ax.legend(loc="upper left")
        ax.set_aspect("equal")
    return figure


def _closed(points: np.ndarray) -> np.ndarray:
    return np.vstack([points, points[:1]])
