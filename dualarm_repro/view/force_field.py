"""How attraction and repulsion act on a point in a plane."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from .labels import name_point, push_apart
from .style import BLACK, BLUE, GREEN, ORANGE, RED, WIDTH, house_style

_NAMES = ("attraction", "repulsion", "resultant")


def force_field_figure(
    potential: Callable[[np.ndarray], np.ndarray],
    forces: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]],
    goal: np.ndarray,
    centre: np.ndarray,
    radius: float,
    points: np.ndarray,
) -> Any:
    """Level lines of a potential in the plane and, at some points, both forces and their sum.

    Parameters
    ----------
    potential
        U of points (N, 2).
    forces
        Attraction and repulsion (2,) at a point (2,); arrows show directions and relative lengths.
    """
    x, y = np.meshgrid(np.linspace(-0.2, 1.2, 141), np.linspace(-0.5, 0.6, 111))
    values = potential(np.stack([x.ravel(), y.ravel()], axis=1)).reshape(x.shape)
    outside = np.hypot(x - centre[0], y - centre[1]) > 1.02 * radius
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 5.4))
        levels = np.quantile(values[outside], np.linspace(0.02, 0.97, 22))
        ax.contour(x, y, np.where(outside, values, np.nan), levels=np.unique(levels), colors="0.7",
                   linewidths=0.7)  # fmt: skip
        ax.add_patch(plt.Circle((centre[0], centre[1]), radius, color=ORANGE, alpha=0.5))
        ax.plot(*goal, "*", color=BLACK, ms=14)
        both = np.array([forces(point) for point in points])
        told = int(np.linalg.norm(both[:, 1], axis=1).argmax())
        texts = [name_point(ax, centre, "obstacle", (0, 0)), name_point(ax, goal, "goal", (0, 14))]
        for k, (point, (attraction, repulsion)) in enumerate(zip(points, both, strict=True)):
            scale = 0.22 / max(np.linalg.norm(attraction), np.linalg.norm(repulsion))
            for force, color, name in zip(
                (attraction, repulsion, attraction + repulsion), (GREEN, RED, BLUE), _NAMES,
                strict=True,
            ):  # fmt: skip
                ax.quiver(*point, *(scale * force), color=color, angles="xy", scale_units="xy",
                          scale=1, width=0.006, zorder=3)  # fmt: skip
                if k == told:
                    texts.append(name_point(ax, point + scale * force, name, (0, 9), color=color,
                                            weight="bold"))  # fmt: skip
            ax.plot(*point, "o", color=BLACK, ms=4, zorder=4)
        ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
        push_apart(figure, texts[1:])
    return figure
