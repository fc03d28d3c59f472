"""Curves over the searches of a planner: joint angles, flange coordinates, the splice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from .style import BLACK, ORANGE, PALETTE, house_style

_LEAST_SPAN = 0.5  # of an axis of joint angles [deg]


def coordinate_figure(
    runs: Mapping[str, np.ndarray],
    marks: Mapping[str, np.ndarray] | None = None,
    xlabel: str = "search",
) -> Any:
    """x, y and z of the flange over the samples; ``marks`` are points (3,) drawn as levels."""
    with house_style():
        figure, axes = plt.subplots(1, 3, figsize=(11, 3.4))
        for k, ax in enumerate(axes):
            for color, (name, tcp) in zip(PALETTE, runs.items(), strict=False):
                ax.plot(tcp[:, k], color=color, label=name, lw=1.6)
            for style, (name, point) in zip(("--", ":"), (marks or {}).items(), strict=False):
                ax.axhline(point[k], color=BLACK, ls=style, lw=1, label=name)
            ax.set(xlabel=xlabel, ylabel=f"{'xyz'[k]} of the flange [m]")
        _legend_below(figure, axes[0])
    return figure


def joint_figure(
    runs: Mapping[str, np.ndarray],
    junctions: Sequence[float] = (),
    xlabel: str = "sample of the path",
) -> Any:
    """All joint angles of one or several paths (N, nq) in degrees, junctions as vertical lines."""
    count = next(iter(runs.values())).shape[1]
    with house_style():
        figure, axes = plt.subplots(2, (count + 1) // 2, figsize=(11, 5.4), sharex=True)
        for j, ax in enumerate(axes.flat[:count]):
            for k, (name, path) in enumerate(runs.items()):
                ax.plot(np.rad2deg(path[:, j]), color=PALETTE[k], label=name, lw=1.6)
            for k, junction in enumerate(junctions):
                ax.axvline(junction, color=PALETTE[k], ls=":", lw=1)
            low, high = ax.get_ylim()
            if high - low < _LEAST_SPAN:  # rounding is no motion
                ax.set_ylim(-_LEAST_SPAN, _LEAST_SPAN)
            ax.set(ylabel=f"joint {j + 1} [deg]", xlabel=xlabel)
        _legend_below(figure, axes.flat[0])
    return figure


def splice_figure(
    path: np.ndarray, smooth: np.ndarray, junction: float, joints: Sequence[int], window: int = 12
) -> Any:
    """Two or more joints around the junction of a path (N, nq), raw and smoothed, in degrees."""
    low, high = max(int(junction) - window, 0), int(junction) + window + 2
    samples = np.arange(len(path))[low:high]
    with house_style():
        figure, axes = plt.subplots(1, len(joints), figsize=(4.2 * len(joints), 3.4))
        for ax, j in zip(axes, joints, strict=True):
            ax.plot(samples, np.rad2deg(path[low:high, j]), ".-", color=ORANGE, label="joined")
            ax.plot(samples, np.rad2deg(smooth[low:high, j]), color=PALETTE[0], label="smoothed")
            ax.axvline(junction, color=BLACK, ls=":", lw=1, label="junction")
            ax.set(xlabel="sample of the path", ylabel=f"joint {j + 1} [deg]")
        _legend_below(figure, axes[0])
    return figure


def _legend_below(figure: Any, ax: Any) -> None:
    handles, labels = ax.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))
