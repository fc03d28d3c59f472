"""Point clouds of workspaces and their volumes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import to_rgb

from ..arms.occupancy import RotationVolume
from ..arms.workspace import VoxelVolume
from .labels import name_ends, name_point
from .style import BLACK, BLUE, ORANGE, WIDTH, house_style, name_axes, same_scale

_CELL = 0.03  # of a picture of the density [m]


def volume_figure(
    points: np.ndarray, body: Sequence[RotationVolume], voxels: Sequence[VoxelVolume]
) -> Any:
    """Cloud (n, 3) of one arm, its half section with its limits, and its volume over the cells."""
    with house_style():
        figure = plt.figure(figsize=(WIDTH, 6.6))
        figure.set_layout_engine("constrained", w_pad=0.12)
        grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1), height_ratios=(1.35, 1))
        space = figure.add_subplot(grid[0, 0], projection="3d")
        space.scatter(*points.T, s=0.1, c=points[:, 2], cmap="cividis", alpha=0.35, rasterized=True)
        name_axes(space)
        same_scale(space, zoom=0.88)
        space.set_title(f"{len(points)} positions of the flange")
        _section(figure.add_subplot(grid[0, 1]), points)
        volume = figure.add_subplot(grid[1, :])
        volume.plot(*zip(*((b.cell, b.volume) for b in body), strict=True), "o-", color=BLUE,
                      label="rotation body")  # fmt: skip
        volume.plot(*zip(*((v.cell, v.volume) for v in voxels), strict=True), "s--", color=ORANGE,
                      label="voxels of the cloud")  # fmt: skip
        volume.set(xlabel="cell size [m]", ylabel="volume [m$^3$]", ylim=(0, None))
        volume.set_title("volume over the cell size")
        name_ends(volume)
    return figure


def _section(ax: Any, points: np.ndarray) -> None:
    """Half section, with the largest distance from axis 1 and the range of z."""
    radius, z = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
    drawn = ax.hexbin(radius, z, gridsize=60, bins="log", cmap="cividis", mincnt=1)
    drawn.set_rasterized(True)
    ax.set(xlabel="distance from axis 1 [m]", ylabel="z [m]", aspect="equal")
    ax.set_title("half section, log density")
    for value, shift in ((z.min(), -7), (z.max(), 7)):
        ax.axhline(value, color=BLACK, ls=":", lw=1)
        name_point(ax, np.array([0.75 * radius.max(), value]), f"z = {value:.2f} m", (0, shift))
    ax.axvline(radius.max(), color=BLACK, ls=":", lw=1)
    name_point(ax, np.array([radius.max(), z.min() + 0.3]), f"{radius.max():.2f} m", (2, 0),
               rotation=90)  # fmt: skip
    ax.set(xlim=(0, 1.12 * radius.max()), ylim=(z.min() - 0.4, z.max() + 0.4))


def cloud_figure(clouds: Mapping[str, np.ndarray], colors: Sequence[str]) -> Any:
    """Clouds (n, 3) of several arms on one scale, seen from above and along x."""
    tall = [float(np.ptp(np.vstack(list(clouds.values()))[:, k])) for k in (0, 2)]
    with house_style():
        figure, axes = plt.subplots(2, 1, figsize=(WIDTH, 7.4), sharex=True, height_ratios=tall)
        views = (("from above", 0), ("along x", 2))
        for ax, (title, up) in zip(axes, views, strict=True):
            for (name, points), color in zip(clouds.items(), colors, strict=True):
                _density(ax, points[:, 1], points[:, up], color)
                outer = np.sign(points[:, 1].mean()) * 0.32 * np.ptp(points[:, 1])
                middle = np.array([points[:, 1].mean() + outer, points[:, up].max()])
                name_point(ax, middle, name, (0, 0), color=color, weight="bold", fontsize=10)
            ax.set(xlabel="y [m]", ylabel=f"{'xyz'[up]} [m]", title=title, aspect="equal")
            ax.autoscale()
            ax.margins(0.03)
    return figure


def _density(ax: Any, x: np.ndarray, y: np.ndarray, color: str) -> None:
    """How many points lie over each place, as the strength of a colour."""
    edges = [np.arange(v.min() - _CELL, v.max() + 2 * _CELL, _CELL) for v in (x, y)]
    counts = np.histogram2d(x, y, bins=edges)[0].T
    picture = np.zeros((*counts.shape, 4))
    picture[..., :3] = to_rgb(color)
    picture[..., 3] = 0.75 * np.sqrt(counts / np.quantile(counts[counts > 0], 0.98)).clip(0, 1)
    ends = (edges[0][0], edges[0][-1], edges[1][0], edges[1][-1])
    ax.imshow(picture, extent=ends, origin="lower", interpolation="none", zorder=2)
