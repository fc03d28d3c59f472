"""Shares with their confidence intervals, and counts of what happened in many cases."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from ..ledger.shares import Share
from .style import BLACK, BLUE, PALETTE, house_style


def shares_figure(
    rows: Mapping[str, Mapping[str, Share]], xlabel: str, mark: tuple[float, str] | None = None
) -> Any:
    """Horizontal bars: one row per name, one colour per group within it; ``mark`` is a share to
    compare with, and its name."""
    groups = list(dict.fromkeys(group for row in rows.values() for group in row))
    height = 0.8 / len(groups)
    with house_style():
        figure, ax = plt.subplots(figsize=(8.4, 1.4 + (0.3 + 0.28 * len(groups)) * len(rows)))
        for g, group in enumerate(groups):
            found = [(k, row[group]) for k, row in enumerate(rows.values()) if group in row]
            place = np.array([k for k, _ in found]) + (g - 0.5 * (len(groups) - 1)) * height
            values = np.array([share.value for _, share in found])
            ends = np.array(
                [[share.value - share.low, share.high - share.value] for _, share in found]
            )
            ax.barh(place, values, height=0.9 * height, color=PALETTE[g], label=group,
                    xerr=ends.T.clip(min=0.0), error_kw={"lw": 1, "capsize": 2})  # fmt: skip
        if mark:
            ax.axvline(mark[0], color=BLACK, ls="--", lw=1, label=mark[1])
        ax.set_yticks(range(len(rows)), list(rows))
        ax.invert_yaxis()
        ax.set(xlabel=xlabel, ylabel="", xlim=(0, 1.02))
        ax.set_ylabel(" ")
        ax.grid(axis="y", visible=False)
        if mark or len(groups) > 1:
            ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def count_grid_figure(counts: np.ndarray, xlabel: str, ylabel: str, marked: tuple[int, int]) -> Any:
    """How often each pair of counts occurred (A, B), with one pair framed."""
    with house_style():
        figure, ax = plt.subplots(figsize=(6.0, 5.2))
        image = ax.imshow(np.log1p(counts), cmap="cividis", origin="lower")
        for (i, j), count in np.ndenumerate(counts):
            if count:
                shade = "black" if np.log1p(count) > 0.6 * np.log1p(counts.max()) else "white"
                ax.text(j, i, str(int(count)), ha="center", va="center", fontsize=7, color=shade)
        ax.add_patch(plt.Rectangle((marked[1] - 0.5, marked[0] - 0.5), 1, 1, fill=False,
                                   ec="#D55E00", lw=2.5))  # fmt: skip
        ax.set(
            xlabel=xlabel,
            ylabel=ylabel,
            xticks=range(counts.shape[1]),
            yticks=range(counts.shape[0]),
        )
        ax.grid(visible=False)
        image.set_clim(0, None)
    return figure


def curve_figure(
    x: Sequence[float],
    curves: Mapping[str, Sequence[Share]],
    xlabel: str,
    ylabel: str,
    *,
    log: bool,
) -> Any:
    """Shares over a quantity, with their intervals as bands."""
    with house_style():
        figure, ax = plt.subplots(figsize=(7.0, 3.8))
        for color, (name, shares) in zip(PALETTE, curves.items(), strict=False):
            ax.plot(x, [share.value for share in shares], "o-", color=color, label=name)
            bounds = [share.low for share in shares], [share.high for share in shares]
            ax.fill_between(x, *bounds, color=color or BLUE, alpha=0.2)
        ax.set(xlabel=xlabel, ylabel=ylabel, ylim=(0, None))
        if log:
            ax.set_xscale("log")
        if len(curves) > 1:
            ax.legend()
    return figure
