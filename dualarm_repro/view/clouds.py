"""Point clouds of workspaces and their volumes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.layout_engine import ConstrainedLayoutEngine

from ..arms.occupancy import RotationVolume
from ..arms.workspace import VoxelVolume
from .style import BLUE, ORANGE, house_style


def volume_figure(
    points: np.ndarray, body: Sequence[RotationVolume], voxels: Sequence[VoxelVolume]
) -> Any:
    """Cloud (n, 3) of one arm, its half section, and its volume over the size of the cells."""
    with house_style():
        figure = plt.figure(figsize=(12, 4.2), layout=ConstrainedLayoutEngine(w_pad=0.2))
        space = figure.add_subplot(1, 3, 1, projection="3d", box_aspect=(1, 1, 0.7))
        space.scatter(*points.T, s=0.1, c=points[:, 2], cmap="cividis", alpha=0.35, rasterized=True)
        space.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
        space.locator_params(nbins=4)
        space.set_aspect("equal")
        section = figure.add_subplot(1, 3, 2)
        radius = np.hypot(points[:, 0], points[:, 1])
        section.hexbin(radius, points[:, 2], gridsize=70, bins="log", cmap="cividis", mincnt=1)
        section.set(xlabel="distance from axis 1 [m]", ylabel="z [m]", aspect="equal")
        section.set_title("half section, log density")
        volume = figure.add_subplot(1, 3, 3)
        volume.plot(*zip(*((b.cell, b.volume) for b in body), strict=True), "o-", color=BLUE,
                      label="rotation body")  # fmt: skip
        volume.plot(*zip(*((v.cell, v.volume) for v in voxels), strict=True), "s--", color=ORANGE,
                      label="voxels of the cloud")  # fmt: skip
        volume.set(xlabel="cell size [m]", ylabel="volume [m$^3$]", ylim=(0, None))
        volume.set_title("volume over the cell size")
        volume.legend()
    return figure


def cloud_figure(clouds: Mapping[str, np.ndarray], colors: Sequence[str]) -> Any:
    """Clouds (n, 3) of several arms, seen from above and along x."""
    with house_style():
        figure, axes = plt.subplots(1, 2, figsize=(10, 5))
        views = (("from above", 0, 1), ("along x", 1, 2))
        for ax, (title, i, j) in zip(axes, views, strict=True):
            for (name, points), color in zip(clouds.items(), colors, strict=True):
                ax.scatter(points[:, i], points[:, j], s=0.15, color=color, alpha=0.15,
                           rasterized=True, label=name)  # fmt: skip
            ax.set(xlabel=f"{'xyz'[i]} [m]", ylabel=f"{'xyz'[j]} [m]", title=title, aspect="equal")
        legend = axes[0].legend(loc="upper left", markerscale=30)
        for handle in legend.legend_handles:
            handle.set_alpha(1.0)
    return figure
