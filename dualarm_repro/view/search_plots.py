"""Plots of searches: histories of a genetic algorithm, best individuals, optimisers compared."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from .style import BLACK, BLUE, ORANGE, RED, house_style


def history_figure(curves: Mapping[str, np.ndarray], ylabel: str) -> Any:
    """Histories (runs, generations) of several quantities: median, band of all, single runs."""
    with house_style():
        figure, ax = plt.subplots(figsize=(7.2, 4.2))
        for color, (name, values) in zip((BLUE, ORANGE, RED), curves.items(), strict=False):
            generation = np.arange(values.shape[1])
            ax.fill_between(
                generation, values.min(axis=0), values.max(axis=0), color=color, alpha=0.2
            )
            ax.plot(generation, values.T, color=color, lw=0.5, alpha=0.4)
            ax.plot(generation, np.median(values, axis=0), color=color, lw=2.2, label=name)
        ax.set(xlabel="generation", ylabel=ylabel, ylim=(0, None))
        ax.margins(x=0)
        ax.legend()
    return figure


def best_individual_figure(best: np.ndarray, printed: np.ndarray) -> Any:
    """Coordinates of the best individual of every run (runs, 3), beside the printed ones."""
    position = np.arange(3)
    with house_style():
        figure, ax = plt.subplots(figsize=(6.4, 4.0))
        ax.axhline(0, color=BLACK, lw=0.8)
        ax.bar(position - 0.2, best[0], 0.36, color=BLUE, label="first run")
        ax.bar(position + 0.2, printed, 0.36, color=ORANGE, label="printed")
        for k in range(3):
            shift = np.linspace(-0.32, -0.08, len(best))
            ax.plot(
                k + shift, best[:, k], "o", color=BLACK, ms=4, label="all runs" if not k else None
            )
        ax.set_xticks(position, ["x", "y", "z"])
        ax.set(xlabel="coordinate", ylabel="best individual [m]")
        ax.legend()
    return figure


def optimisers_figure(table: pd.DataFrame, truth: float, budget: int) -> Any:
    """Gap to the ground truth and CPU time of every run, one row for each optimiser."""
    names = list(dict.fromkeys(table["optimiser"]))
    with house_style():
        figure, (ax, right) = plt.subplots(
            1, 2, figsize=(9.6, 0.5 * len(names) + 1.8), sharey=True, width_ratios=(2, 1)
        )
        for k, name in enumerate(names):
            rows = table[table["optimiser"] == name]
            gap = np.maximum(1.0 - rows["fitness"] / truth, 1e-9)
            height = k + np.linspace(-0.2, 0.2, len(rows))
            ax.plot(gap, height, "o", color=BLUE, ms=5, alpha=0.7)
            ax.plot([gap.median()] * 2, [k - 0.32, k + 0.32], color=BLACK, lw=2)
            right.plot(rows["seconds"], height, "o", color=ORANGE, ms=5, alpha=0.7)
        ax.axvline(1e-3, color=RED, ls="--", lw=1)
        ax.text(1e-3, -0.75, " 0.1 %", color=RED, va="bottom")
        ax.set(xscale="log", xlabel=f"gap to the ground truth after {budget} evaluations")
        ax.set_yticks(range(len(names)), names)
        ax.invert_yaxis()
        ax.set_ylabel("optimiser")
        right.set(xlabel="CPU time [s]", ylabel="optimiser", xlim=(0, None))
    return figure
