"""Shares with their confidence intervals, and counts of what happened in many cases."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from ..ledger.shares import Share
from .labels import name_ends
from .style import (
    BLACK,
    BLUE,
    FIXED_BLACK,
    FIXED_WHITE,
    PALETTE,
    RED,
    SMALL,
    WIDTH,
    house_style,
    ink,
)

_LETTERS = 30  # of a name before it is broken
#: Letters of a legend across the figure, and those that a sample of a colour takes.
_LINE, _SAMPLE = 96, 6
_BAR = 0.2  # height of a bar with its number [in]


def shares_figure(
    rows: Mapping[str, Mapping[str, Share]], xlabel: str, mark: tuple[float, str] | None = None
) -> Any:
    """Horizontal bars with their numbers: one row per name, one colour per group within it.

    ``mark`` is a share to compare with, and its name.
    """
    groups = list(dict.fromkeys(group for row in rows.values() for group in row))
    height = 0.8 / len(groups)
    with house_style():
        tall = 1.2 + (0.12 + max(_BAR * len(groups), 0.32)) * len(rows)
        figure, ax = plt.subplots(figsize=(WIDTH, tall))
        for g, group in enumerate(groups):
            found = [(k, row[group]) for k, row in enumerate(rows.values()) if group in row]
            place = np.array([k for k, _ in found]) + (g - 0.5 * (len(groups) - 1)) * height
            values = np.array([100 * share.value for _, share in found])
            low = np.array([100 * share.low for _, share in found])
            high = np.array([100 * share.high for _, share in found])
            ends = np.array([values - low, high - values]).clip(min=0.0)
            ax.barh(place, values, height=0.9 * height, color=PALETTE[g], label=group, alpha=0.85,
                    xerr=ends, error_kw={"lw": 1, "capsize": 2})  # fmt: skip
            for y, value, end in zip(place, values, high, strict=True):
                ax.text(end + 1.2, y, _percent(value), va="center", fontsize=SMALL + 0.5)
        if mark:
            ax.axvline(100 * mark[0], color=BLACK, ls="--", lw=1.4, label=mark[1])
        ax.set_yticks(range(len(rows)), [fill(name, _LETTERS) for name in rows])
        ax.invert_yaxis()
        ax.set(xlabel=f"{xlabel} [%]", xlim=(0, 108), xticks=range(0, 101, 20))
        ax.grid(axis="y", visible=False)
        if mark or len(groups) > 1:
            names = [*groups, mark[1]] if mark else groups
            columns = _LINE // (max(map(len, names)) + _SAMPLE)
            figure.legend(loc="outside upper left", ncols=max(1, min(len(names), columns, 3)))
    return figure


def _percent(value: float) -> str:
    return f"{value:.0f} %" if value >= 9.95 or value == 0 else f"{value:.1f} %"


def count_grid_figure(counts: np.ndarray, xlabel: str, ylabel: str, marked: tuple[int, int]) -> Any:
    """How often each pair of counts occurred (A, B), with one pair framed."""
    total = int(counts.sum())
    with house_style():
        figure, ax = plt.subplots(figsize=(6.6, 6.0))
        image = ax.imshow(np.log1p(counts), cmap="cividis", origin="lower")
        for (i, j), count in np.ndenumerate(counts):
            if count:
                light = np.log1p(count) > 0.6 * np.log1p(counts.max())
                ax.text(j, i, str(int(count)), ha="center", va="center", fontsize=SMALL + 0.5,
                        color=FIXED_BLACK if light else FIXED_WHITE)  # fmt: skip
        ax.add_patch(plt.Rectangle((marked[1] - 0.5, marked[0] - 0.5), 1, 1, fill=False,
                                   ec=RED, lw=3))  # fmt: skip
        found = int(counts[marked])
        ax.set_title(f"framed: {marked[0]} and {marked[1]}, in {found} of {total}", color=ink(RED))
        ax.set(xlabel=xlabel, ylabel=ylabel, xticks=range(counts.shape[1]),
               yticks=range(counts.shape[0]))  # fmt: skip
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
    """Shares over a quantity, with their intervals as bands; curves are named at their ends."""
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 3.8))
        for color, (name, shares) in zip(PALETTE, curves.items(), strict=False):
            ax.plot(x, [share.value for share in shares], "o-", color=color, label=name)
            bounds = [share.low for share in shares], [share.high for share in shares]
            ax.fill_between(x, *bounds, color=color or BLUE, alpha=0.2)
        ax.set(xlabel=xlabel, ylabel=ylabel, ylim=(0, None))
        if log:
            ax.set_xscale("log")
        if len(curves) > 1:
            name_ends(ax)
    return figure
