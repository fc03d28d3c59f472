"""Curves over the searches of a planner: joint angles, flange coordinates, the splice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from .style import BLACK, ORANGE, PALETTE, WIDTH, house_style

_IN_ONE_LINE = 5  # names of a legend
_LEAST_SPAN = 0.1  # of a joint that is given a panel [deg]


def coordinate_figure(
    runs: Mapping[str, np.ndarray],
    marks: Mapping[str, np.ndarray] | None = None,
    xlabel: str = "search",
    ends: Mapping[str, tuple[int, np.ndarray]] | None = None,
) -> Any:
    """x, y and z of the flange over the samples; ``marks`` are points (3,) drawn as levels,
    ``ends`` a sample and a point (3,) drawn there.

    A dot marks the end of each curve.
    """
    with house_style():
        figure, axes = plt.subplots(1, 3, figsize=(WIDTH, 3.1), sharex=True)
        for k, ax in enumerate(axes):
            for color, (name, tcp) in zip(PALETTE, runs.items(), strict=False):
                ax.plot(tcp[:, k], color=color, label=name, lw=1.6)
                ax.plot(len(tcp) - 1, tcp[-1, k], "o", color=color, ms=4)
            for style, (name, point) in zip(("--", ":"), (marks or {}).items(), strict=False):
                ax.axhline(point[k], color=BLACK, ls=style, lw=1.3, label=name)
            _mark_ends(ax, ends or {}, k)
            ax.set(xlabel=xlabel, ylabel=f"{'xyz'[k]} of the flange [m]")
        _legend_above(figure, axes[0])
    return figure


def joint_figure(
    runs: Mapping[str, np.ndarray],
    junctions: Sequence[float] = (),
    xlabel: str = "sample of the path",
    ends: Mapping[str, tuple[int, np.ndarray]] | None = None,
) -> Any:
    """Joint angles of one or several paths (N, nq) in degrees, junctions as vertical lines,
    ``ends`` as a sample and a posture (nq,) [rad] drawn there.

    A joint that hardly moves has no panel: the last title names it with how far it moves.
    """
    spans = np.rad2deg(np.max([np.ptp(path, axis=0) for path in runs.values()], axis=0))
    moving = np.flatnonzero(spans >= _LEAST_SPAN)
    columns = max(1, min(3, (len(moving) + 1) // 2))
    rows = max(1, -(-len(moving) // columns))
    with house_style():
        figure, grid = plt.subplots(
            rows, columns, figsize=(WIDTH, 2.2 * rows + 0.5), sharex=True, squeeze=False
        )
        for ax in grid.flat[len(moving) :]:
            ax.set_visible(False)
        for ax, j in zip(grid.flat, moving, strict=False):
            for k, (name, path) in enumerate(runs.items()):
                ax.plot(np.rad2deg(path[:, j]), color=PALETTE[k], label=name, lw=1.6)
            for k, junction in enumerate(junctions):
                ax.axvline(junction, color=PALETTE[k], ls=":", lw=1.3)
            _mark_ends(ax, {n: (at, np.rad2deg(q)) for n, (at, q) in (ends or {}).items()}, int(j))
            ax.set(ylabel=f"joint {j + 1} [deg]")
        for ax in grid.flat[max(len(moving) - columns, 0) : len(moving)]:
            ax.set_xlabel(xlabel)
            ax.tick_params(labelbottom=True)
        still = [f"{j + 1} ({_tiny(spans[j])})" for j in np.flatnonzero(spans < _LEAST_SPAN)]
        _legend_above(figure, grid.flat[0], "junction" if len(junctions) else None)
        if still:
            figure.supxlabel(f"not drawn, since they hardly move: joint {' and '.join(still)}",
                             fontsize=9, x=0.01, ha="left")  # fmt: skip
    return figure


def splice_figure(
    path: np.ndarray, smooth: np.ndarray, junction: float, joints: Sequence[int], window: int = 12
) -> Any:
    """Two or more joints around the junction of a path (N, nq), raw and smoothed, in degrees.

    Below each angle stands its bend, the second difference, in which the junction shows.
    """
    low, high = max(int(junction) - window, 1), int(junction) + window + 2
    samples = np.arange(len(path))[low:high]
    both = (("joined", path, ORANGE, ".-"), ("smoothed", smooth, PALETTE[0], "-"))
    with house_style():
        figure, axes = plt.subplots(
            2, len(joints), figsize=(WIDTH, 4.6), sharex=True, squeeze=False
        )
        for column, j in enumerate(joints):
            top, below = axes[:, column]
            for name, angles, color, style in both:
                degrees = np.rad2deg(angles[:, j])
                bend = degrees[2:] - 2 * degrees[1:-1] + degrees[:-2]
                top.plot(samples, degrees[low:high][: len(samples)], style, color=color, label=name)
                below.plot(samples[: len(bend) - low + 1], bend[low - 1 : high - 1][: len(samples)],
                           style, color=color)  # fmt: skip
            for ax in (top, below):
                ax.axvline(junction, color=BLACK, ls=":", lw=1.3)
            span = float(np.ptp(np.rad2deg(path[:, j])))
            top.set(ylabel=f"joint {j + 1} [deg]", title=f"joint {j + 1} moves by {span:.2g} deg")
            below.set(xlabel="sample of the path", ylabel="bend [deg per sample²]")
            for ax in (top, below):
                ax.ticklabel_format(axis="y", useOffset=False, scilimits=(-3, 4))
        _legend_above(figure, axes[0, 0], "junction")
    return figure


def _mark_ends(ax: Any, ends: Mapping[str, tuple[int, np.ndarray]], k: int) -> None:
    """Entry k of the points at the ends of a path, in front of the curves."""
    for marker, (name, (sample, point)) in zip(("o", "*", "X"), ends.items(), strict=False):
        fill, size = ("white", 7) if marker == "o" else (BLACK, 9)
        look = {"color": BLACK, "mfc": fill, "ms": size, "ls": "none", "zorder": 5}
        ax.plot(sample, point[k], marker, label=name, **look)


def _tiny(span: float) -> str:
    """A small angle; rounding is none."""
    return f"{span:.2g} deg" if span > 1e-9 else "at rest"


def _legend_above(figure: Any, ax: Any, dotted: str | None = None) -> None:
    """One line of names above the panels, ``dotted`` for vertical lines."""
    handles, labels = ax.get_legend_handles_labels()
    if dotted:
        handles.append(plt.Line2D([], [], color="0.3", ls=":", lw=1.3))
        labels.append(dotted)
    figure.legend(handles, labels, loc="outside upper left", ncols=min(len(labels), _IN_ONE_LINE))
