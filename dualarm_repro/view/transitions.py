"""Chart of states and of the transitions that runs really took."""

from __future__ import annotations

from collections.abc import Mapping
from textwrap import fill
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import FancyBboxPatch

from .style import BLUE, ORANGE, RED, WIDTH, house_style, ink

_WIDE, _HIGH = 2.05, 0.5  # of a box [in]
_SIDE = 0.14  # between the two ways of a loop [in]


def transitions_figure(
    places: Mapping[str, tuple[float, float]],
    transitions: Mapping[tuple[str, str], int],
    reasons: Mapping[tuple[str, str], str] | None = None,
) -> Any:
    """States at the given places, an arrow per transition with how often it was taken.

    A state that is left in several ways is a decision and drawn in another colour; ``reasons`` say
    when a way is taken.
    """
    xs, ys = (np.array(side) for side in zip(*places.values(), strict=True))
    wide = max(float(np.ptp(xs)), 1e-9)
    at = {
        name: np.array([0.5 * _WIDE + 0.1 + (x - xs.min()) / wide * (WIDTH - _WIDE - 0.2)
                        if np.ptp(xs) else 0.5 * WIDTH, 0.95 * (y - ys.min()) + 0.35])
        for name, (x, y) in places.items()
    }  # fmt: skip
    height = 0.95 * float(np.ptp(ys)) + 0.7
    ways = [source for source, _ in transitions]
    with house_style():
        figure = plt.figure(figsize=(WIDTH, height), layout="none")
        ax = figure.add_axes((0, 0, 1, 1), xlim=(0, WIDTH), ylim=(0, height))
        ax.axis("off")
        for k, (name, centre) in enumerate(at.items()):
            color = ORANGE if ways.count(name) > 1 else BLUE
            x, y = centre
            ax.add_patch(FancyBboxPatch(
                (x - 0.5 * _WIDE, y - 0.5 * _HIGH), _WIDE, _HIGH, facecolor=color + "26",
                boxstyle="round,pad=0,rounding_size=0.08", edgecolor=color, lw=1.4, zorder=2,
                gid=f"box-{k}"))  # fmt: skip
            ax.text(x, y, fill(name, 27), ha="center", va="center", fontsize=9, zorder=3,
                    gid=f"box-{k}")  # fmt: skip
        for pair, count in transitions.items():
            _way(ax, at, pair, pair[::-1] in transitions, str(count), (reasons or {}).get(pair))
    return figure


def _way(
    ax: Any, at: Mapping[str, np.ndarray], pair: tuple[str, str], back: bool, count: str,
    reason: str | None,
) -> None:  # fmt: skip
    """An arrow from box to box, to the right of its own return; the count stands on it."""
    a, b = at[pair[0]], at[pair[1]]
    along = (b - a) / np.linalg.norm(b - a)
    aside = np.array([along[1], -along[0]]) * (_SIDE if back else 0.0)
    start, end = a + aside + along * _leave(along), b + aside - along * _leave(along)
    arrow = {"arrowstyle": "-|>", "color": "0.35", "lw": 1.3, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", end, start, arrowprops=arrow, zorder=1)
    middle = 0.5 * (start + end)
    name = count if reason is None else f"{count}: {reason}"
    sideways = abs(along[0]) > abs(along[1])
    shift = (0.0, np.sign(aside[1] or 1.0) * 0.12) if sideways else (0.08, 0.0)
    ax.text(*(middle + shift), name, color=ink(RED), ha="center" if sideways else "left",
            va="center", fontsize=9, weight="bold", zorder=4)  # fmt: skip


def _leave(along: np.ndarray) -> float:
    """From the centre of a box to its edge."""
    with np.errstate(divide="ignore"):
        return float(min(0.5 * _WIDE / abs(along[0]) if along[0] else np.inf,
                         0.5 * _HIGH / abs(along[1]) if along[1] else np.inf))  # fmt: skip
