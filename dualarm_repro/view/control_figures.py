"""Figures of velocity control: distances over time, penalties, decays, accuracy against time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from .crossing import Crossing, crossing_axes
from .labels import name_ends, name_point, push_apart
from .style import BLACK, BLUE, GREEN, ORANGE, PALETTE, PURPLE, WIDTH, house_style

_RANGES = ("inner range", "outer range")


def comparison_figure(
    curves: Mapping[str, tuple[np.ndarray, np.ndarray]],
    postures: Mapping[str, Crossing],
    ranges: tuple[float, float],
) -> Any:
    """Distance of two arms over time with and without avoidance, and postures when nearest.

    Parameters
    ----------
    curves
        Name to times (N,) and distances (N,) [m].
    postures
        Name to both arms at one instant.
    ranges
        Inner and outer range [m].
    """
    least = {name: 1e3 * float(values.min()) for name, (_, values) in curves.items()}
    with house_style():
        figure = plt.figure(figsize=(WIDTH, 7.0))
        grid = figure.add_gridspec(2, len(postures), height_ratios=(1.5, 1.0))
        spaces = [figure.add_subplot(grid[0, k], projection="3d") for k in range(len(postures))]
        crossing_axes(spaces, list(postures.values()))
        for ax, name in zip(spaces, postures, strict=True):
            ax.set_title(f"{name}: {least[name]:.0f} mm" if name in least else name)
        ax = figure.add_subplot(grid[1, :])
        for (name, (times, values)), color in zip(curves.items(), (PURPLE, GREEN), strict=True):
            ax.plot(times, 1e3 * values, color=color, label=name, lw=2)
            k = int(values.argmin())
            ax.plot(times[k], 1e3 * values[k], "o", color=color, ms=5)
            name_point(ax, np.array([times[k], 1e3 * values[k]]), f"{least[name]:.0f} mm", (0, -11),
                       color=color)  # fmt: skip
        low, high = min(least.values()) - 35, max(1e3 * d.max() for _, d in curves.values()) + 15
        ax.axhspan(low, 0.0, color=PURPLE, alpha=0.1, lw=0)
        ax.text(times[0], 0.5 * low, " the arms overlap", va="center", fontsize=9)
        _range_lines(ax, ranges)
        ax.set(xlabel="time [s]", ylabel="smallest distance [mm]", ylim=(low, high))
        ax.margins(x=0)
        name_ends(ax)
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
        figure, axes = plt.subplots(
            3, 1, figsize=(WIDTH, 6.4), sharex=True, height_ratios=(2, 2, 1)
        )
        axes[0].plot(times, 1e3 * distance, color=BLUE, label="distance")
        _range_lines(axes[0], ranges)
        axes[0].set(ylabel="distance [mm]")
        axes[1].plot(times, bound, color=BLACK, ls="--", lw=1, label="its bound")
        axes[1].plot(times, approach, color=ORANGE, label="approach of\nthe pair with\nleast room")
        axes[1].set(ylabel="speed [m/s]")
        axes[2].step(times, rows, color=GREEN, where="post")
        axes[2].set(xlabel="time [s]", ylabel="active rows")
        axes[2].margins(x=0)
        for ax in axes[:2]:
            name_ends(ax)
    return figure


def _range_lines(ax: Any, ranges: tuple[float, float]) -> None:
    for value, style, label in zip(ranges, ("-", "--"), _RANGES, strict=True):
        ax.axhline(1e3 * value, color=BLACK, ls=style, lw=0.9, label=label)


def penalty_figure(g: np.ndarray, forms: Mapping[str, np.ndarray]) -> Any:
    """Penalties over the violation of an inequality; dashes tell curves that coincide apart."""
    dashes = ("-", "-", "--", "-.", ":")
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 3.8))
        for k, (name, values) in enumerate(forms.items()):
            ax.plot(g, values, dashes[k % len(dashes)], label=name.replace("_", " "),
                    lw=4 - 2 * min(k, 1), alpha=0.5 if k == 0 else 1.0)  # fmt: skip
        ax.set(xlabel="violation g", ylabel="penalty", ylim=(-0.02, 0.5))
        ax.axvline(0.0, color=BLACK, lw=0.8)
        ax.margins(x=0)
        ax.text(0.0, 0.47, "  violated", va="center", fontsize=9)
        ax.text(0.0, 0.47, "met  ", va="center", ha="right", fontsize=9)
        name_ends(ax)
    return figure


def decay_figure(curves: Mapping[str, tuple[np.ndarray, np.ndarray]], threshold: float) -> Any:
    """Decays in pairs of one colour, full and dashed, with the time to pass a threshold."""
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 4.8))
        for k, (name, (times, values)) in enumerate(curves.items()):
            color, style = PALETTE[k // 2], ("-", "--")[k % 2]
            above = np.flatnonzero(values > threshold)
            last = int(above[-1]) + 1 if len(above) else 0
            told = f"{times[last]:.2g} s" if last < len(times) else "not in time"
            shown = times > 0
            ax.plot(times[shown], np.maximum(values[shown], 1e-12), style, color=color,
                    label=f"{name}: {told}")  # fmt: skip
            if last < len(times) and times[last] > 0:
                ax.plot(times[last], threshold, "o", color=color, ms=5)
        ax.axhline(threshold, color=BLACK, lw=0.8)
        ax.text(0.1, threshold, "threshold", va="bottom", fontsize=9,
                transform=ax.get_yaxis_transform())  # fmt: skip
        ax.set(xlabel="time [s]", ylabel="error", ylim=(1e-6, None), xscale="log", yscale="log")
        ax.margins(x=0)
        figure.legend(loc="outside lower left", ncols=2, title="below the threshold for good after",
                      alignment="left")  # fmt: skip
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
        figure, ax = plt.subplots(figsize=(WIDTH, 4.4))
        ax.axhline(floor, color=BLACK, ls=":", lw=1)
        texts = [name_point(ax, np.array([1.0, floor]), f"{floor:g} or less", (-32, 7),
                            xycoords=ax.get_yaxis_transform())]  # fmt: skip
        for k, (name, (times, quartiles, errors)) in enumerate(series.items()):
            shown = np.maximum(errors, floor)
            ax.errorbar(times, shown, xerr=np.abs(quartiles - times), fmt="o-", color=PALETTE[k],
                        capsize=2)  # fmt: skip
            least = int(shown.argmin())
            exact = errors[least] <= floor
            told = name if exact else f"{name}: {errors[least]:.1e}"
            # Those at the floor stand side by side, their names above and below in turn.
            side = 12 if exact and k % 2 else -12
            texts.append(name_point(ax, np.array([times[least], shown[least]]), told, (0, side),
                                    color=PALETTE[k]))  # fmt: skip
        ax.set(xscale="log", yscale="log", xlabel="time per problem [us]",
               ylabel="largest error [rad/s]", ylim=(0.2 * floor, None))  # fmt: skip
        ax.margins(x=0.12)
        push_apart(figure, texts[1:])
    return figure


def convergence_figure(
    series: Mapping[str, tuple[np.ndarray, np.ndarray]], threshold: float
) -> Any:
    """Distance from the minimiser over the number of steps, both logarithmic, with the step that
    comes within a threshold for good; what lies a millionth below it is left out."""
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 4.2))
        texts = []
        for k, (name, (count, values)) in enumerate(series.items()):
            ax.loglog(count, np.maximum(values, 1e-14), color=PALETTE[k], lw=2)
            above = np.flatnonzero(values > threshold)
            last = int(above[-1]) + 1 if len(above) else 0
            at = min(last, len(count) - 1)
            told = f"{name}: {count[at]:.0f} steps" if last < len(count) else f"{name}: not reached"
            ax.plot(count[at], values[at], "o", color=PALETTE[k])
            texts.append(name_point(ax, np.array([count[at], values[at]]), told, (-84, -12),
                                    color=PALETTE[k]))  # fmt: skip
        ax.axhline(threshold, color=BLACK, lw=0.8)
        ax.text(0.995, threshold, f"threshold {threshold:g}", ha="right", va="bottom", fontsize=9,
                transform=ax.get_yaxis_transform())  # fmt: skip
        ax.set(
            xlabel="steps",
            ylabel="distance from the minimiser [rad/s]",
            ylim=(max(1e-14, 1e-6 * threshold), None),
        )
        push_apart(figure, texts)
    return figure
