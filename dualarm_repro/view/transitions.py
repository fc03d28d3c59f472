"""Chart of states and of the transitions that runs really took."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt

from .style import BLUE, RED, house_style

_BOX = {"boxstyle": "round,pad=0.4", "facecolor": "white", "edgecolor": BLUE, "lw": 1.6}


def transitions_figure(
    places: Mapping[str, tuple[float, float]], transitions: Mapping[tuple[str, str], int]
) -> Any:
    """States at the given places, an arrow per transition with how often it was taken."""
    with house_style():
        figure, ax = plt.subplots(figsize=(8.6, 6.4))
        ax.axis("off")
        for name, (x, y) in places.items():
            ax.text(x, y, name, ha="center", va="center", bbox=_BOX, zorder=3)
        for (source, target), count in transitions.items():
            a, b = places[source], places[target]
            back = (target, source) in transitions
            arc = f"arc3,rad={0.25 if back else 0.0}"
            ax.annotate("", b, a, zorder=1, arrowprops={
                "arrowstyle": "-|>", "color": "0.35", "lw": 1.3, "connectionstyle": arc,
                "shrinkA": 13, "shrinkB": 13})  # fmt: skip
            share = 0.5 if back else 0.65
            middle = a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])
            if back:  # beside its own arc
                middle = middle[0] + 0.13 * (b[1] - a[1]), middle[1] - 0.13 * (b[0] - a[0])
            ax.text(*middle, str(count), color=RED, ha="center", va="center", zorder=4,
                    bbox={"facecolor": "white", "edgecolor": "none", "pad": 1})  # fmt: skip
        xs, ys = zip(*places.values(), strict=True)
        ax.set_xlim(min(xs) - 0.8, max(xs) + 0.8)
        ax.set_ylim(min(ys) - 0.6, max(ys) + 0.6)
    return figure
