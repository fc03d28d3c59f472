"""Figures of velocity control: distances over time, penalties, decays, accuracy against time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from .style import BLACK, BLUE, GREEN, MASTER, ORANGE, PALETTE, RED, SLAVE, house_style


def comparison_figure(
    curves: Mapping[str, tuple[np.ndarray, np.ndarray]],
    postures: Mapping[str, Sequence[np.ndarray]],
    ranges: tuple[float, float],
) -> Any:
    """Distance of two arms over time with and without avoidance, and postures when nearest.

    Parameters
    ----------
    curves
        Name to times (N,) and distances (N,) [m].
    postures
        Name to skeletons of the arms, each (K, 3) [m], followed by the paths of the tips (N, 3).
    ranges
        Inner and outer range [m].
    """
    with house_style():
        figure = plt.figure(figsize=(9.6, 7.2))
        grid = figure.add_gridspec(2, len(postures), height_ratios=(1.6, 1.0))
        for k, (name, (left, right, *paths)) in enumerate(postures.items()):
            ax = figure.add_subplot(grid[0, k], projection="3d")
            for points, color in ((left, MASTER), (right, SLAVE)):
                ax.plot(*points.T, color=color, lw=11, alpha=0.35, solid_capstyle="round")
                ax.plot(*points.T, "o-", color=color, lw=2, ms=4)
            for path, color in zip(paths, (MASTER, SLAVE), strict=True):
                ax.plot(*path.T, color=color, lw=1)
            ax.set(title=name, xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
            ax.locator_params(nbins=4)
            ax.view_init(elev=48, azim=-75)
            ax.set_aspect("equal")
            ax.set_box_aspect(None, zoom=1.0)
        ax = figure.add_subplot(grid[1, :])
        for (name, (times, distances)), color in zip(curves.items(), (RED, BLUE), strict=True):
            ax.plot(times, 1e3 * distances, color=color, label=name)
        ax.axhspan(-1e4, 0.0, color=RED, alpha=0.08, lw=0)
        for value, style, label in zip(
            ranges, ("-", "--"), ("inner range", "outer range"), strict=True
        ):
            ax.axhline(1e3 * value, color=BLACK, ls=style, lw=0.9, label=label)
        low = min(float(d.min()) for _, d in curves.values())
        high = max(float(d.max()) for _, d in curves.values())
        ax.set(
            xlabel="time [s]",
            ylabel="smallest distance [mm]",
            ylim=(1e3 * low - 15, 1e3 * high + 45),
        )
        ax.legend(ncols=4, loc="upper center", fontsize=8.5)
    return figure


def damper_figure(
    times: np.ndarray,
    distance: np.ndarray,
    rows: np.ndarray,
    approach: np.ndarray,
    bound: np.ndarray,
    ranges: tuple[float, float],
) -> Any:
    """Smallest distance between two ranges, approach of the tightest pair and its bound, rows."""
    with house_style():
        figure, axes = plt.subplots(3, 1, figsize=(8.0, 6.4), sharex=True, height_ratios=(2, 2, 1))
        axes[0].plot(times, 1e3 * distance, color=BLUE)
        for value, style, label in zip(
            ranges, ("-", "--"), ("inner range", "outer range"), strict=True
        ):
            axes[0].axhline(1e3 * value, color=BLACK, ls=style, lw=0.9, label=label)
        axes[0].set(ylabel="distance [mm]")
        axes[0].legend()
        axes[1].plot(times, bound, color=BLACK, ls="--", lw=1, label="bound")
        axes[1].plot(times, approach, color=ORANGE, label="approach of the pair with least room")
        axes[1].set(ylabel="speed [m/s]")
        axes[1].legend()
        axes[2].step(times, rows, color=GREEN, where="post")
        axes[2].set(xlabel="time [s]", ylabel="active rows")
    return figure


def penalty_figure(g: np.ndarray, forms: Mapping[str, np.ndarray]) -> Any:
    """Penalties over the violation of an inequality."""
    with house_style():
        figure, ax = plt.subplots(figsize=(6.4, 3.8))
        for name, values in forms.items():
            ax.plot(g, values, label=name.replace("_", " "))
        ax.set(xlabel="violation g", ylabel="penalty", ylim=(-0.02, 0.5))
        ax.axvline(0.0, color=BLACK, lw=0.8)
        ax.legend()
    return figure


def decay_figure(curves: Mapping[str, tuple[np.ndarray, np.ndarray]], threshold: float) -> Any:
    """Decays on a logarithmic scale, in pairs of one colour: full line and dashed line."""
    with house_style():
        figure, ax = plt.subplots(figsize=(7.0, 4.2))
        for k, (name, (times, values)) in enumerate(curves.items()):
            color, style = PALETTE[k // 2], ("-", "--")[k % 2]
            ax.semilogy(times, np.maximum(values, 1e-12), style, color=color, label=name)
        ax.axhline(threshold, color=BLACK, lw=0.8, label="threshold")
        ax.set(xlabel="time [s]", ylabel="error", ylim=(1e-6, None))
        ax.legend(fontsize=8.5)
    return figure


def contest_figure(
    series: Mapping[str, tuple[np.ndarray, np.ndarray, np.ndarray]], floor: float
) -> Any:
    """Error against time a problem, one line per method; quartiles of the time as bars.

    Parameters
    ----------
    series
        Name to times (N,), their lower and upper quartile (2, N), and errors (N,).
    floor
        Errors below are drawn there.
    """
    with house_style():
        figure, ax = plt.subplots(figsize=(7.0, 4.4))
        for k, (name, (times, quartiles, errors)) in enumerate(series.items()):
            spread = np.abs(quartiles - times)
            ax.errorbar(
                times,
                np.maximum(errors, floor),
                xerr=spread,
                fmt="o-",
                color=PALETTE[k],
                label=name,
            )
        ax.set(
            xscale="log",
            yscale="log",
            xlabel="time per problem [us]",
            ylabel="largest error [rad/s]",
        )
        ax.legend()
    return figure


def convergence_figure(
    series: Mapping[str, tuple[np.ndarray, np.ndarray]], threshold: float
) -> Any:
    """Residual over the number of iterations, both logarithmic."""
    with house_style():
        figure, ax = plt.subplots(figsize=(7.0, 4.2))
        for k, (name, (count, values)) in enumerate(series.items()):
            ax.loglog(count, np.maximum(values, 1e-14), color=PALETTE[k], label=name)
        ax.axhline(threshold, color=BLACK, lw=0.8, label="threshold")
        ax.set(xlabel="steps", ylabel="residual")
        ax.legend()
    return figure
