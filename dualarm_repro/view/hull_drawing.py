"""A convex hull around an arm."""

from __future__ import annotations

from typing import Any

import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ..scene import ConvexHull, PlacedArm
from .arm_drawings import skeleton
from .style import BLUE, RED, axes_3d, house_style


def hull_figure(placed: PlacedArm, q: np.ndarray, hull: ConvexHull, rings: np.ndarray) -> Any:
    """Stick figure of an arm, circles (C, n, 3) at its joints and their hull, from two sides."""
    with house_style():
        figure, axes = axes_3d(10, 5, columns=2)
        for ax, azimuth in zip(axes, (-60, 20), strict=True):
            faces = Poly3DCollection(hull.vertices[hull.faces], alpha=0.15, facecolor=BLUE)
            faces.set_edgecolor("0.8")
            faces.set_linewidth(0.4)
            ax.add_collection3d(faces)
            closed = np.concatenate([rings, rings[:, :1]], axis=1)
            for k, ring in enumerate(closed):
                ax.plot(*ring.T, color=RED, lw=1.2, label="circles" if k == 0 else None)
            ax.plot(*skeleton(placed.arm, q, placed.placement).T, "o-", color="0.3", lw=3, ms=4,
                    label="arm")  # fmt: skip
            ax.view_init(elev=18, azim=azimuth)
            ax.set_aspect("equal")
        axes[0].legend(loc="upper left")
    return figure
