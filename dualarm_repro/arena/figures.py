"""Figures of the arena."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from ..view.style import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, SKY, WIDTH, YELLOW, house_style
from .judged import Outcome
from .study import PAPERS
from .summary import methods_of, outcome_counts, profile, success_table

_OUTCOMES = {
    Outcome.SUCCESS: (GREEN, ""),
    Outcome.UNDECIDED: (YELLOW, ""),
    Outcome.LIMITS: (PURPLE, "//"),
    Outcome.COLLIDES: (RED, "xx"),
    Outcome.OTHER_POSTURE: (BLUE, "//"),
    Outcome.STOPPED: (SKY, ""),
    Outcome.REFUSED: ("#BBBBBB", ".."),
}
_LINES = ("-", "--", "-.", ":")


def success_figure(rows: pd.DataFrame) -> Figure:
    """Certified successes with their intervals, and what the planners say of themselves."""
    table = success_table(rows).iloc[::-1]
    at = np.arange(len(table))
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 0.3 * len(table) + 1.4))
        today = np.array([name not in PAPERS for name in table.index])
        for mine, color, marker, whose in (
            (~today, BLUE, "o", "documents' methods"),
            (today, ORANGE, "s", "today's planners"),
        ):
            rows = table[mine]
            ax.hlines(at[mine], rows["low"], rows["high"], color=color, lw=3, alpha=0.5)
            label = f"{whose}, certified (95 % interval)"
            ax.scatter(rows["share"], at[mine], color=color, marker=marker, zorder=3, label=label)
        ax.scatter(
            table["claimed"], at, marker="|", s=90, color=BLACK, zorder=4, label="planner's claim"
        )
        ax.set(xlim=(-0.02, 1.02), xlabel="share of the feasible tasks", yticks=at)
        ax.set_yticklabels(table.index)
        ax.margins(y=0.03)
        figure.legend(loc="outside upper center", ncols=2)
    return figure


def outcome_figure(rows: pd.DataFrame) -> Figure:
    """How the runs of each method ended, on all tasks."""
    counts = outcome_counts(rows).iloc[::-1]
    left = np.zeros(len(counts))
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 0.3 * len(counts) + 1.6))
        for outcome, (color, hatch) in _OUTCOMES.items():
            width = counts[str(outcome)].to_numpy(dtype=float)
            ax.barh(
                counts.index, width, left=left, color=color, hatch=hatch, label=str(outcome),
                edgecolor="white", height=0.8,
            )  # fmt: skip
            left += width
        ax.set_xlabel("number of tasks")
        ax.margins(y=0.02)
        ax.grid(axis="y", visible=False)
        figure.legend(loc="outside upper center", ncols=3)
    return figure


def profile_figure(rows: pd.DataFrame, column: str, label: str) -> Figure:
    """Share of the feasible tasks done within a ratio of the best, over the ratio."""
    ratios = np.geomspace(1.0, 10.0, 91)
    found = profile(rows, column, ratios)
    best = sorted(methods_of(rows), key=lambda name: -found[name].iloc[-1])[:8]
    colors = (BLUE, ORANGE, GREEN, RED, PURPLE, SKY, BLACK, "#7A7000")
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 3.8))
        for name in best:
            k = methods_of(rows).index(name)  # a method looks the same in every figure
            line = _LINES[(k + k // len(colors)) % len(_LINES)]
            ax.plot(ratios, found[name], color=colors[k % len(colors)], ls=line, label=name)
        ax.set(
            xscale="log", xlim=(1.0, 10.0), ylim=(0.0, 1.02), xlabel=label,
            ylabel="share of the feasible tasks",
        )  # fmt: skip
        ax.set_xticks([1, 2, 5, 10], ["1", "2", "5", "10"])
        ax.minorticks_off()
        figure.legend(loc="outside upper center", ncols=3)
    return figure
