"""Success rates over a parameter, and distances over the samples of a motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from .style import BLACK, PALETTE, house_style


def rate_figure(
    x: Sequence[float],
    rates: Mapping[str, Mapping[str, Sequence[tuple[float, float, float]]]],
    xlabel: str,
    mark: tuple[float, str] | None = None,
) -> Any:
    """One panel per group: success rates with intervals (value, low, high) over a log scale."""
    with house_style():
        figure, axes = plt.subplots(1, len(rates), figsize=(5.2 * len(rates), 3.8), sharey=True)
        for ax, (title, curves) in zip(np.atleast_1d(axes), rates.items(), strict=True):
            for k, (name, values) in enumerate(curves.items()):
                value, low, high = 100.0 * np.array(values).T
                color, style = PALETTE[k % len(PALETTE)], ("-", "--")[k // len(PALETTE)]
                ax.plot(x, value, style, marker="o", ms=4, color=color, label=name)
                ax.fill_between(x, low, high, color=color, alpha=0.12, lw=0)
            if mark:
                ax.axvline(mark[0], color=BLACK, ls=":", lw=1)
                ax.text(
                    mark[0], 50, f" {mark[1]}", rotation=90, va="center", ha="right", fontsize=8
                )
            ax.set(xscale="log", xlabel=xlabel, ylabel="success [%]", title=title, ylim=(-4, 104))
        np.atleast_1d(axes)[0].legend(loc="center left", fontsize="small")
    return figure
