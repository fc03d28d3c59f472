"""Diagrams of boxes and arrows: columns of steps, a loop, a device."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from textwrap import fill
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.patches import FancyBboxPatch, Polygon

from .style import BLACK, BLUE, GREEN, ORANGE, house_style

_COLORS = (BLUE, GREEN, ORANGE)
#: Width and height of a step of a loop, and the gap below it.
_WIDTH, _HEIGHT, _GAP = 4.4, 0.74, 0.42


def flow_chart(steps: Sequence[tuple[str, str, str]]) -> Any:
    """Steps (part, text, code) from top to bottom, one column per part."""
    parts = list(dict.fromkeys(part for part, _, _ in steps))
    deepest = max(sum(step[0] == part for step in steps) for part in parts)
    with house_style():
        figure, ax = plt.subplots(figsize=(4.0 * len(parts), 1.15 * deepest + 0.6))
        ax.axis("off")
        ends = []
        for column, part in enumerate(parts):
            x, color = 1.5 * column, _COLORS[column]
            ax.text(x, 0.75, part, ha="center", weight="bold", color=color)
            own = [step for step in steps if step[0] == part]
            for row, (_, text, code) in enumerate(own):
                _box(ax, x, -row, f"{text}\n", color)
                ax.text(
                    x, -row - 0.14, code, ha="center", va="center", family="monospace", fontsize=8
                )
                if row:
                    _arrow(ax, (x, 1 - row - 0.32), (x, -row + 0.32))
            ends.append((x, 1 - len(own)))
        for (x, y), nxt in zip(ends[:-1], range(1, len(parts)), strict=True):
            _arrow(ax, (x + 0.66, y), (1.5 * nxt - 0.66, 0.0))
        ax.set(xlim=(-0.72, 1.5 * len(parts) - 0.78), ylim=(0.45 - deepest, 1.0))
    return figure


def loop_chart(
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
            _step(ax, y, _title(step), decides=step is decision)
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


def block_diagram(numbers: Mapping[str, str], program: Sequence[str]) -> Any:
    """A device with numbered processor, memory and the program that lies in the memory."""
    with house_style():
        figure, ax = plt.subplots(figsize=(7.6, 4.0))
        ax.axis("off")
        ax.add_patch(plt.Rectangle((-0.78, -1.62), 3.3, 2.35, fill=False, color=BLACK, lw=1.2))
        _box(ax, 0.0, 0.0, f"processor {numbers['processor']}", BLUE)
        ax.add_patch(plt.Rectangle((0.95, -1.5), 1.45, 2.05, fill=False, color=GREEN, lw=1.2))
        ax.text(1.68, 0.36, f"memory {numbers['memory']}", ha="center", color=GREEN)
        lines = "\n".join(f"{k}. {text}" for k, text in enumerate(program, start=1))
        ax.text(1.0, -0.55, f"program {numbers['program']}\n\n{lines}", va="center", fontsize=9)
        _arrow(ax, (0.95, 0.0), (0.66, 0.0))
        ax.set(xlim=(-0.85, 2.6), ylim=(-1.7, 0.8))
    return figure


def _box(ax: Any, x: float, y: float, text: str, color: str) -> None:
    style = "round,pad=0.02"
    ax.add_patch(
        FancyBboxPatch(
            (x - 0.64, y - 0.3),
            1.28,
            0.6,
            boxstyle=style,
            facecolor="white",
            edgecolor=color,
            lw=1.4,
        )
    )
    ax.text(x, y, text, ha="center", va="center", fontsize=11)


def _arrow(ax: Any, start: tuple[float, float], end: tuple[float, float]) -> None:
    ax.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": BLACK, "lw": 1.2})


def _title(step: Callable[..., Any]) -> str:
    return (step.__doc__ or step.__name__).splitlines()[0].rstrip(".")


def _half(step: Callable[..., Any], decision: Callable[..., Any]) -> float:
    return 0.5 * _HEIGHT + (0.14 if step is decision else 0.0)


def _step(ax: Any, y: float, text: str, *, decides: bool) -> None:
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
