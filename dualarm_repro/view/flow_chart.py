"""Flow chart of a loop, drawn from the functions that make it up."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from textwrap import fill
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.patches import FancyBboxPatch, Polygon

from .style import BLUE, ORANGE, house_style

_WIDTH, _HEIGHT, _GAP = 4.4, 0.74, 0.42


def flow_chart(
    first: Callable[..., Any], loop: Sequence[Callable[..., Any]], decision: Callable[..., Any]
) -> Any:
    """Boxes with the first docstring line of each function; the decision ends the loop."""
    steps = [first, *loop]
    with house_style():
        figure, ax = plt.subplots(figsize=(7.0, 1.25 * len(steps) + 0.6))
        ax.axis("off")
        places = {}
        for k, step in enumerate(steps):
            y = -k * (_HEIGHT + _GAP)
            places[step] = y
            _node(ax, y, _title(step), decides=step is decision)
            if k:
                above = y + _HEIGHT + _GAP
                _arrow(
                    ax, (0, above - _half(steps[k - 1], decision)), (0, y + _half(step, decision))
                )
        end = places[decision]
        ax.text(0.15, end - _half(decision, decision) - 0.2, "no", va="center")
        ax.text(0.5 * _WIDTH + 0.75, end + 0.08, "yes")
        _arrow(ax, (0.5 * _WIDTH + 0.55, end), (0.5 * _WIDTH + 1.45, end))
        ax.text(0.5 * _WIDTH + 1.5, end, "best\nindividual", va="center")
        low, back, left = places[steps[-1]], places[loop[0]], -0.5 * _WIDTH - 0.7
        start = (-0.5 * _WIDTH, low)
        ax.plot([start[0], left, left], [low, low, back], color="0.3", lw=1.2)
        _arrow(ax, (left, back), (-0.5 * _WIDTH, back))
        ax.text(
            left - 0.1, 0.5 * (low + back), "next generation", rotation=90, va="center", ha="right"
        )
        ax.set_xlim(left - 0.6, 0.5 * _WIDTH + 2.6)
        ax.set_ylim(low - _HEIGHT, _HEIGHT)
    return figure


def _title(step: Callable[..., Any]) -> str:
    return (step.__doc__ or step.__name__).splitlines()[0].rstrip(".")


def _half(step: Callable[..., Any], decision: Callable[..., Any]) -> float:
    return 0.5 * _HEIGHT + (0.14 if step is decision else 0.0)


def _node(ax: Any, y: float, text: str, *, decides: bool) -> None:
    if decides:
        half, tall = 0.5 * _WIDTH + 0.55, 0.5 * _HEIGHT + 0.14
        corners = [(-half, y), (0, y + tall), (half, y), (0, y - tall)]
        ax.add_patch(Polygon(corners, facecolor=ORANGE, alpha=0.25, edgecolor=ORANGE))
    else:
        corner = (-0.5 * _WIDTH, y - 0.5 * _HEIGHT)
        style = "round,pad=0,rounding_size=0.12"
        ax.add_patch(
            FancyBboxPatch(
                corner, _WIDTH, _HEIGHT, boxstyle=style, facecolor=BLUE, alpha=0.15, edgecolor=BLUE
            )
        )
    ax.text(0, y, fill(text, 36 if decides else 46), ha="center", va="center", fontsize=9)


def _arrow(ax: Any, start: tuple[float, float], end: tuple[float, float]) -> None:
    ax.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": "0.3", "lw": 1.2})
