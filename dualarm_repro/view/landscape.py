"""Slices of a fitness landscape and sensitivities of an optimum."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from ..welding import Placement, Status
from ..welding.grid_search import grid_points
from ..welding.placement import blocks
from .style import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, WIDTH, house_style

_STEPS = 49


def slices_figure(
    fitness: Callable[[np.ndarray], np.ndarray],
    box: np.ndarray,
    optimum: np.ndarray,
    best: float,
    printed: np.ndarray,
) -> Any:
    """Fitness on the three planes through the optimum; grey where no position is feasible.

    The line encloses what comes within one per cent of the best fitness; the printed point is
    projected onto each plane.
    """
    with house_style():
        figure, axes = plt.subplots(1, 3, figsize=(WIDTH, 3.9))
        for ax, (i, j) in zip(axes, ((0, 1), (0, 2), (1, 2)), strict=True):
            across, up = (np.linspace(box[k, 0], box[k, 1], _STEPS) for k in (i, j))
            points = np.tile(optimum, (_STEPS * _STEPS, 1))
            grid = np.meshgrid(across, up, indexing="ij")
            points[:, i], points[:, j] = grid[0].ravel(), grid[1].ravel()
            values = fitness(points).reshape(_STEPS, _STEPS)
            shown = np.ma.masked_less_equal(values, 0.0)
            ax.set_facecolor("0.88")
            ax.grid(False)
            mesh = ax.pcolormesh(across, up, shown.T, cmap="viridis", vmin=0, vmax=best,
                                 rasterized=True)  # fmt: skip
            ax.contour(across, up, values.T, levels=[0.99 * best], colors=RED, linewidths=1.5)
            ax.plot(optimum[i], optimum[j], "*", color=RED, ms=13, mec="white", label="optimum")
            ax.plot(printed[i], printed[j], "X", color=ORANGE, ms=10, mec=BLACK, label="printed")
            ax.set(xlabel=f"{'xyz'[i]} [m]", ylabel=f"{'xyz'[j]} [m]", aspect="equal")
        axes[0].plot([], [], color=RED, label="99 % of the best")
        figure.colorbar(mesh, ax=axes, label="fitness", location="bottom", shrink=0.6, aspect=40)
        figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper left", ncols=3)
    return figure


#: Outcome of the constraints to its colour in maps.
_OUTCOMES = {
    Status.FEASIBLE: GREEN,
    Status.OUT_OF_REACH: "0.85",
    Status.JOINT_LIMITS: ORANGE,
    Status.SINGULAR: PURPLE,
    Status.COLLISION: RED,
}


def statuses_figure(placement: Placement, box: np.ndarray) -> Any:
    """Which constraint excludes a position, on two planes through the best point of a grid."""
    points = grid_points(box, 0.15)
    centre = points[placement(points).argmax()]
    colors = ListedColormap(list(_OUTCOMES.values()))
    with house_style():
        figure, axes = plt.subplots(1, 2, figsize=(WIDTH, 4.0))
        for ax, (i, j) in zip(axes, ((0, 1), (1, 2)), strict=True):
            across, up = (np.linspace(box[k, 0], box[k, 1], _STEPS) for k in (i, j))
            grid = np.meshgrid(across, up, indexing="ij")
            points = np.tile(centre, (_STEPS * _STEPS, 1))
            points[:, i], points[:, j] = grid[0].ravel(), grid[1].ravel()
            found = np.concatenate([placement.jobs(some).status for some in blocks(points)])
            ax.pcolormesh(across, up, found.reshape(_STEPS, _STEPS).T, cmap=colors,
                          vmin=-0.5, vmax=4.5, rasterized=True)  # fmt: skip
            other = 3 - i - j
            ax.set(xlabel=f"{'xyz'[i]} [m]", ylabel=f"{'xyz'[j]} [m]", aspect="equal",
                   title=f"{'xyz'[other]} = {centre[other] + 0.0:.2f} m")  # fmt: skip
            ax.grid(False)
        patches = [
            Patch(facecolor=color, edgecolor="0.4", label=status.name.lower().replace("_", " "))
            for status, color in _OUTCOMES.items()
        ]
        figure.legend(handles=patches, loc="outside lower center", ncols=5)
    return figure


def sensitivity_figure(table: pd.DataFrame, nominal: np.ndarray, printed: np.ndarray) -> Any:
    """Coordinates of the optimum when one assumption at a time is changed.

    ``table`` has a row for each change with columns ``assumption``, ``value``, ``x``, ``y``, ``z``.
    The x coordinate is shown without its sign, since mirror images are as good as each other.
    """
    names = list(dict.fromkeys(table["assumption"]))
    with house_style():
        figure, axes = plt.subplots(1, 3, figsize=(WIDTH, 0.26 * len(names) + 1.4), sharey=True)
        for k, (ax, color) in enumerate(zip(axes, (BLUE, GREEN, ORANGE), strict=True)):
            for row, name in enumerate(names):
                values = table.loc[table["assumption"] == name, "xyz"[k]].dropna()
                values = values.abs() if k == 0 else values
                centre = abs(nominal[k]) if k == 0 else nominal[k]
                ends = [min(values.min(), centre), max(values.max(), centre)] if len(values) else []
                ax.plot(
                    ends, [row] * len(ends), color=color, lw=5, alpha=0.35, solid_capstyle="butt"
                )
                ax.plot(values, [row] * len(values), "o", color=color, ms=4)
            ax.axvline(centre, color=BLACK, lw=1)
            ax.axvline(abs(printed[k]) if k == 0 else printed[k], color=RED, ls="--", lw=1)
            ax.set(xlabel=("|x| [m]", "y [m]", "z [m]")[k])
        axes[0].set_yticks(range(len(names)), [name.replace("_", " ") for name in names])
        axes[0].invert_yaxis()
        axes[0].set_ylabel("assumption")
        axes[0].plot([], [], color=BLACK, label="declared assumptions")
        axes[0].plot([], [], color=RED, ls="--", label="printed point")
        figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper left", ncols=2)
    return figure


def readings_figure(
    optima: Sequence[tuple[str, np.ndarray]],
    printed: np.ndarray,
    shares: pd.DataFrame,
    radii: tuple[float, float],
) -> Any:
    """Where the optima of several readings lie, and how often each comes near the printed point.

    Parameters
    ----------
    optima
        Name of a reading and its optima (N, 3).
    shares
        Share of optima within ``radii[1]``: one row for each objective, one column a reading.
    """
    colors = (BLUE, ORANGE)
    with house_style():
        figure = plt.figure(figsize=(WIDTH, 4.2 + 0.26 * len(shares)))
        grid = figure.add_gridspec(2, 2, height_ratios=(3.2, 0.26 * len(shares) + 0.3))
        for column, (i, j) in enumerate(((0, 1), (1, 2))):
            ax = figure.add_subplot(grid[0, column])
            for color, (name, points) in zip(colors, optima, strict=True):
                ax.plot(points[:, i], points[:, j], ".", color=color, ms=3, alpha=0.35, label=name,
                        rasterized=True)  # fmt: skip
            angle = np.linspace(0, 2 * np.pi, 90)
            for radius, dash in zip(radii, ("-", "--"), strict=True):
                circle = printed[i] + radius * np.cos(angle), printed[j] + radius * np.sin(angle)
                ax.plot(*circle, color=BLACK, lw=1.4, ls=dash, label=f"within {radius:g} m")
            ax.plot(
                printed[i], printed[j], "X", color=RED, ms=11, mec="white", label="printed point"
            )
            ax.set(xlabel=f"{'xyz'[i]} [m]", ylabel=f"{'xyz'[j]} [m]", aspect="equal")
        handles, names = ax.get_legend_handles_labels()
        large = [copy(handle) for handle in handles]
        for handle in large:
            handle.set(markersize=8, alpha=1.0)
        figure.legend(large, names, loc="outside upper left", ncols=3)
        below, rows = figure.add_subplot(grid[1, :]), np.arange(len(shares))
        for shift, color, column in zip((-0.2, 0.2), colors, shares.columns, strict=True):
            below.barh(rows + shift, 100 * shares[column], 0.38, color=color)
        below.set_yticks(rows, shares.index)
        below.invert_yaxis()
        below.set(
            xlabel=f"optima within {radii[1]:g} m of the printed point [%]", ylabel="objective"
        )
    return figure
