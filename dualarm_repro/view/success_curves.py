"""Success rates over a parameter, and distances over the samples of a motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from .style import BLACK, PALETTE, WIDTH, house_style

_DASHES = ("-", "-", "--", "-.", ":")


def rate_figure(
    x: Sequence[float],
    rates: Mapping[str, Mapping[str, Sequence[tuple[float, float, float]]]],
    xlabel: str,
    mark: tuple[float, str] | None = None,
) -> Any:
    """One panel per group: success rates with intervals (value, low, high) over a log scale.

    Dashes and thinner lines tell curves that coincide apart.
    """
    with house_style():
        figure, axes = plt.subplots(1, len(rates), figsize=(WIDTH, 3.9), sharey=True, squeeze=False)
        for ax, (title, curves) in zip(axes[0], rates.items(), strict=True):
            for k, (name, values) in enumerate(curves.items()):
                value, low, high = 100.0 * np.array(values).T
                color = PALETTE[k % len(PALETTE)]
                ax.plot(x, value, _DASHES[k % 5], marker="osD^v"[k % 5], ms=6 - 0.8 * (k % 5),
                        lw=max(3.6 - 0.6 * k, 1.2), color=color, label=name)  # fmt: skip
                ax.fill_between(x, low, high, color=color, alpha=0.12, lw=0)
            if mark:
                ax.axvline(mark[0], color=BLACK, ls=":", lw=1.4)
                ax.text(
                    mark[0], 50, f"{mark[1]} ", rotation=90, va="center", ha="right", fontsize=9
                )
            ax.set(xscale="log", xlabel=xlabel, title=title, ylim=(-4, 104))
        axes[0, 0].set_ylabel("success [%]")
        names = axes[0, 0].get_legend_handles_labels()
        figure.legend(*names, loc="outside upper left", ncols=len(names[0]), handlelength=3)
    return figure
