"""Velocity ellipsoids, their volumes and the weights taken from them."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FixedLocator

from ..welding import ROBOTS
from .labels import name_ends
from .style import BLACK, BLUE, GREEN, ORANGE, RED, WIDTH, house_style, ink, same_scale

ROBOT_COLORS = (BLUE, GREEN, RED)


def ellipsoid_surface(gram: np.ndarray, steps: int = 24) -> tuple[np.ndarray, ...]:
    """Surface {v : v^T A^-1 v = 1} of a matrix A (3, 3) as three arrays for plotting."""
    values, vectors = np.linalg.eigh(gram)
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 2 * steps), np.linspace(0, np.pi, steps))
    sphere = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)])
    return tuple(np.einsum("ij,jkl->ikl", vectors * np.sqrt(values), sphere))


def beta_figure(volumes: np.ndarray, common: np.ndarray, share: np.ndarray) -> Any:
    """Volumes (3, N) of the ellipsoids, their common part (N,), carriers' share of the weight."""
    index = np.arange(volumes.shape[1])
    with house_style():
        figure, (ax, below) = plt.subplots(2, 1, figsize=(WIDTH, 5.0), sharex=True)
        for name, color, values in zip(ROBOTS, ROBOT_COLORS, volumes, strict=True):
            ax.plot(index, values, color=color, label=name)
        ax.plot(index, common, color=BLACK, ls="--", label="common to all")
        ax.set(ylabel="volume [m³/s³]", ylim=(0, None))
        name_ends(ax)
        below.fill_between(index, 0, share, color=BLUE, alpha=0.4, lw=0)
        below.fill_between(index, share, 1, color=ORANGE, alpha=0.4, lw=0)
        below.set(ylabel="share of the weight", xlabel="seam point", ylim=(0, 1))
        below.margins(x=0)
        middle = len(share) // 2
        for name, height in (
            ("carriers", 0.5 * share[middle]),
            ("welder", 0.5 + 0.5 * share[middle]),
        ):
            below.text(index[middle], height, name, ha="center", va="center")
    return figure


def ellipsoid_panels(axes: Any, grams: np.ndarray) -> None:
    """One ellipsoid a panel, all on one scale, with its longest and shortest semi-axis [m/s]."""
    reach = np.sqrt(max(np.linalg.eigvalsh(gram)[-1] for gram in grams))
    for ax, name, color, gram in zip(axes, ROBOTS, ROBOT_COLORS, grams, strict=True):
        values, vectors = np.linalg.eigh(gram)
        ax.plot_surface(*ellipsoid_surface(gram), color=color, alpha=0.3, lw=0, rasterized=True)
        for value, vector in zip(np.sqrt(values), vectors.T, strict=True):
            ax.plot(*np.outer(vector, (-value, value)), color=BLACK, lw=1.2)
        ax.set(xlim=(-reach, reach), ylim=(-reach, reach), zlim=(-reach, reach),
               xlabel="vx [m/s]", ylabel="vy [m/s]", zlabel="vz [m/s]")  # fmt: skip
        same_scale(ax)
        for axis in (ax.xaxis, ax.yaxis, ax.zaxis):
            axis.set_major_locator(FixedLocator([-1, 0, 1]))
        ax.set_title(f"{name}: {np.sqrt(values[-1]):.2f} to {np.sqrt(values[0]):.2f} m/s",
                     color=ink(color), loc="center")  # fmt: skip
