"""A convex hull around an arm."""

from __future__ import annotations

from typing import Any

import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ..scene import ConvexHull, PlacedArm
from .arm_drawings import skeleton
from .labels import name_point, push_apart
from .style import BLUE, RED, WIDTH, axes_3d, house_style, same_scale


def hull_figure(placed: PlacedArm, q: np.ndarray, hull: ConvexHull, rings: np.ndarray) -> Any:
    """Stick figure of an arm, circles (C, n, 3) at its joints and their hull, from two sides."""
    with house_style():
        figure, axes = axes_3d(WIDTH, 4.4, columns=2)
        for ax, azimuth in zip(axes, (-65, -20), strict=True):
            faces = Poly3DCollection(hull.vertices[hull.faces], alpha=0.15, facecolor=BLUE)
            faces.set_edgecolor("0.8")
            faces.set_linewidth(0.4)
            ax.add_collection3d(faces)
            closed = np.concatenate([rings, rings[:, :1]], axis=1)
            for ring in closed:
                ax.plot(*ring.T, color=RED, lw=1.2)
            points = skeleton(placed.arm, q, placed.placement)
            ax.plot(*points.T, "o-", color="0.3", lw=3, ms=4)
            ax.view_init(elev=18, azim=azimuth)
            same_scale(ax)
            widest = closed[int(np.ptp(closed, axis=1).sum(axis=1).argmax())]
            texts = [
                name_point(ax, widest[widest[:, 2].argmax()], "circle", (26, 10), color=RED),
                name_point(ax, points[0], "arm", (-26, 10)),
            ]
            push_apart(figure, texts)
        axes[0].set_title("the hull (blue) from two sides")
    return figure
