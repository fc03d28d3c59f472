"""Plots of searches: histories of a genetic algorithm, best individuals, optimisers compared."""

from __future__ import annotations

from collections.abc import Mapping
from textwrap import fill
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.ticker import LogLocator

from .labels import name_ends
from .style import BLACK, BLUE, ORANGE, RED, SMALL, WIDTH, house_style, ink


def history_figure(curves: Mapping[str, np.ndarray], ylabel: str) -> Any:
    """Histories (runs, generations) of several quantities: median, band of all, single runs.

    Each is named with the median of its last values.
    """
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 4.0))
        for color, (name, values) in zip((BLUE, ORANGE, RED), curves.items(), strict=False):
            generation = np.arange(values.shape[1])
            ax.fill_between(
                generation, values.min(axis=0), values.max(axis=0), color=color, alpha=0.2
            )
            ax.plot(generation, values.T, color=color, lw=0.5, alpha=0.4)
            median = np.median(values, axis=0)
            ax.plot(generation, median, color=color, lw=2.2, label=f"{name}\n{median[-1]:.4g}")
        ax.set(xlabel="generation", ylabel=ylabel)
        ax.set_ylim(-0.06 * ax.get_ylim()[1], None)  # room for the name of a curve that ends at 0
        ax.margins(x=0)
        name_ends(ax)
    return figure


def best_individual_figure(best: np.ndarray, printed: np.ndarray) -> Any:
    """Coordinates of the best individual of every run (runs, 3), beside the printed ones."""
    position = np.arange(3)
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 4.0))
        ax.axhline(0, color=BLACK, lw=0.8)
        for values, shift, color, name in (
            (best[0], -0.2, BLUE, "first run"), (printed, 0.2, ORANGE, "printed")
        ):  # fmt: skip
            ax.bar(position + shift, values, 0.36, color=color, label=name, alpha=0.85)
            for k, value in enumerate(values):
                ax.annotate(f"{value:.3f}", (k + shift, value), (0, 8 if value >= 0 else -8),
                            textcoords="offset points", ha="center", fontsize=SMALL + 1,
                            va="bottom" if value >= 0 else "top")  # fmt: skip
        for k in range(3):
            spread = np.linspace(-0.32, -0.08, len(best))
            ax.plot(
                k + spread, best[:, k], "o", color=BLACK, ms=4, label="all runs" if not k else None
            )
        ax.set_xticks(position, ["x", "y", "z"])
        ax.set(xlabel="coordinate", ylabel="best individual [m]")
        ax.margins(y=0.12)
        figure.legend(loc="outside upper left", ncols=3)
    return figure


def optimisers_figure(table: pd.DataFrame, truth: float, budget: int) -> Any:
    """Gap to the ground truth and CPU time of every run, one row for each optimiser."""
    names = list(dict.fromkeys(table["optimiser"]))
    with house_style():
        figure, (ax, right) = plt.subplots(
            1, 2, figsize=(WIDTH, 0.45 * len(names) + 1.4), sharey=True, width_ratios=(2, 1)
        )
        for k, name in enumerate(names):
            rows = table[table["optimiser"] == name]
            gap = np.maximum(1.0 - rows["fitness"] / truth, 1e-9)
            height = k + np.linspace(-0.2, 0.2, len(rows))
            ax.plot(gap, height, "o", color=BLUE, ms=5, alpha=0.7)
            ax.plot([gap.median()] * 2, [k - 0.32, k + 0.32], color=BLACK, lw=2)
            right.plot(rows["seconds"], height, "o", color=ORANGE, ms=5, alpha=0.7)
        ax.axvline(1e-3, color=RED, ls="--", lw=1)
        ax.text(1e-3, 1.01, "0.1 %", color=ink(RED), va="bottom", ha="center",
                transform=ax.get_xaxis_transform())  # fmt: skip
        ax.set(xscale="log", xlabel=f"gap to the ground truth, {budget} evaluations")
        ax.xaxis.set_major_locator(LogLocator(numticks=6))
        ax.set_yticks(range(len(names)), [fill(name, 20) for name in names])
        ax.invert_yaxis()
        ax.set_ylabel("optimiser")
        right.set(xlabel="CPU time [s]", xlim=(0, None))
    return figure
