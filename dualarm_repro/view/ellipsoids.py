"""Velocity ellipsoids, their volumes and the weights taken from them."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from ..welding import ROBOTS
from .style import BLACK, BLUE, GREEN, ORANGE, RED, house_style

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
        figure, (ax, below) = plt.subplots(2, 1, figsize=(7.2, 5.2), sharex=True)
        for name, color, values in zip(ROBOTS, ROBOT_COLORS, volumes, strict=True):
            ax.plot(index, values, color=color, label=name)
        ax.plot(index, common, color=BLACK, ls="--", label="common to all")
        ax.set(xlabel="seam point", ylabel="volume [m³/s³]", ylim=(0, None))
        ax.legend(ncols=4, loc="upper center", bbox_to_anchor=(0.5, 1.2))
        below.fill_between(index, 0, share, color=BLUE, alpha=0.5, lw=0, label="carriers")
        below.fill_between(index, share, 1, color=ORANGE, alpha=0.5, lw=0, label="welder")
        below.set(ylabel="share of the weight", xlabel="seam point", ylim=(0, 1))
        below.legend(loc="lower right")
        below.margins(x=0)
    return figure
