"""Diagrams of boxes and arrows: columns of steps, a loop, a device; lengths are inches."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from textwrap import fill
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.patches import FancyBboxPatch, Polygon, Rectangle

from .style import BLACK, BLUE, GREEN, ORANGE, WIDTH, house_style, ink

_COLORS = (BLUE, GREEN, ORANGE)
#: Widths of a letter [in]: of text of 9.5 pt, and of code of 8 pt, which are sure to hold it.
_LETTER, _CODE_LETTER = 0.075, 0.068
_LINE = 0.16  # height of a line of text
_PAD = 0.11  # between a box and its text
_GAP = 0.3  # between two boxes
_WIDE = 4.4  # of a step of a loop


def flow_chart(steps: Sequence[tuple[str, str, str]]) -> Any:
    """Steps (part, text, code) from top to bottom, one column per part.

    A box is as high as the text that it holds.
    """
    parts = list(dict.fromkeys(part for part, _, _ in steps))
    wide = min((WIDTH - 0.1) / len(parts) - 0.45, 3.2)
    columns = [[_wrapped(text, code, wide) for part, text, code in steps if part == one]
               for one in parts]  # fmt: skip
    tall = max(sum(_height(text, code) + _GAP for text, code in column) for column in columns)
    pitch = wide + 0.45
    with house_style():
        ax = _sheet(pitch * len(parts) - 0.35, tall + 0.25)
        ends: list[tuple[float, float]] = []
        for k, (part, column) in enumerate(zip(parts, columns, strict=True)):
            x, y, color = 0.05 + k * pitch + 0.5 * wide, tall + 0.02, _COLORS[k]
            ax.text(x, y, part, ha="center", va="center", weight="bold", color=ink(color))
            y -= 0.22
            for row, (text, code) in enumerate(column):
                high = _height(text, code)
                _box(ax, (x, y - 0.5 * high), (wide, high), color, f"{k}-{row}")
                _write(ax, (x, y - 0.5 * high), text, code, f"{k}-{row}")
                if row:
                    _arrow(ax, (x, y + _GAP), (x, y))
                elif ends:
                    _elbow(ax, ends[-1], (x - 0.5 * wide, y - 0.5 * high))
                y -= high + _GAP
            high = _height(*column[-1])
            ends.append((x + 0.5 * wide, y + _GAP + 0.5 * high))
    return ax.figure


def loop_chart(
    first: Callable[..., Any], loop: Sequence[Callable[..., Any]], decision: Callable[..., Any]
) -> Any:
    """Boxes with the first docstring line of each function; the decision ends the loop."""
    steps = [first, *loop]
    texts = {step: fill(_title(step), 34 if step is decision else 50) for step in steps}
    high = {s: _height(t, "") * (2.1 if s is decision else 1.0) for s, t in texts.items()}
    tall = sum(high.values()) + _GAP * (len(steps) - 1)
    x, half = 0.75 + 0.5 * _WIDE, 0.5 * _WIDE
    with house_style():
        ax = _sheet(WIDTH, tall + 0.1)
        middle, y = {}, tall + 0.05
        for k, step in enumerate(steps):
            middle[step] = y - 0.5 * high[step]
            if step is decision:
                corners = [(x - half, middle[step]), (x, y), (x + half, middle[step]),
                           (x, y - high[step])]  # fmt: skip
                ax.add_patch(Polygon(corners, facecolor=ORANGE + "40", edgecolor=ORANGE, lw=1.4,
                                     gid=f"box-{k}"))  # fmt: skip
            else:
                _box(ax, (x, middle[step]), (_WIDE, high[step]), BLUE, str(k))
            _write(ax, (x, middle[step]), texts[step], "", str(k))
            if k:
                _arrow(ax, (x, y + _GAP), (x, y))
            y -= high[step] + _GAP
        end = middle[decision]
        ax.text(x + 0.12, end - 0.5 * high[decision] - 0.5 * _GAP, "no", va="center")
        ax.text(x + half + 0.25, end + 0.1, "yes", ha="center")
        _arrow(ax, (x + half, end), (x + half + 0.5, end))
        ax.text(x + half + 0.58, end, "best\nindividual", va="center")
        low, back, left = middle[steps[-1]], middle[loop[0]], x - half - 0.35
        ax.plot([x - half, left, left], [low, low, back], color=BLACK, lw=1.2)
        _arrow(ax, (left, back), (x - half, back))
        ax.text(left - 0.14, 0.5 * (low + back), "next generation", rotation=90, va="center",
                ha="center")  # fmt: skip
    return ax.figure


def block_diagram(numbers: Mapping[str, str], program: Sequence[str]) -> Any:
    """A device with numbered processor, memory and the program that lies in the memory."""
    wide = 3.9
    letters = int((wide - 2 * _PAD) / _LETTER)
    lines = [fill(f"{k}. {text}", letters, subsequent_indent="    ")
             for k, text in enumerate(program, start=1)]  # fmt: skip
    text = "\n".join(lines)
    inner = _height(text, "") + 0.3
    outer = inner + 0.6
    with house_style():
        ax = _sheet(WIDTH, outer + 0.5)
        ax.add_patch(
            Rectangle((0.05, 0.05), WIDTH - 0.1, outer + 0.4, fill=False, ec=BLACK, lw=1.4)
        )
        ax.text(0.2, outer + 0.28, "device", va="center", weight="bold")
        _box(ax, (1.25, 0.5 * outer + 0.1), (1.8, 0.7), BLUE, "processor")
        _write(ax, (1.25, 0.5 * outer + 0.1), f"processor {numbers['processor']}", "", "processor")
        left, right = WIDTH - wide - 0.55, WIDTH - 0.25
        ax.add_patch(Rectangle((left, 0.2), right - left, outer, fill=False, ec=GREEN, lw=1.4,
                               gid="box-memory"))  # fmt: skip
        ax.text(left + 0.15, outer, f"memory {numbers['memory']}", color=ink(GREEN),
                va="center", weight="bold", gid="box-memory")  # fmt: skip
        _box(ax, (left + 0.15 + 0.5 * wide, 0.3 + 0.5 * inner), (wide, inner), GREEN, "program")
        ax.text(left + 0.15 + _PAD, 0.3 + inner - 0.2, f"program {numbers['program']}",
                va="center", weight="bold", gid="box-program")  # fmt: skip
        ax.text(left + 0.15 + _PAD, 0.3 + 0.5 * (inner - 0.25), text, va="center", linespacing=1.25,
                gid="box-program")  # fmt: skip
        _arrow(ax, (left, 0.5 * outer + 0.1), (2.15, 0.5 * outer + 0.1))
        ax.text(0.5 * (left + 2.15), 0.5 * outer + 0.22, "runs", ha="center")
    return ax.figure


def _sheet(width: float, height: float) -> Any:
    """Axes over a whole figure, in inches."""
    figure = plt.figure(figsize=(width, height), layout="none")
    ax = figure.add_axes((0, 0, 1, 1), xlim=(0, width), ylim=(0, height))
    ax.axis("off")
    return ax


def _wrapped(text: str, code: str, wide: float) -> tuple[str, str]:
    """Lines that a box of a width holds of text and of code, broken at dots and underscores."""
    lines, limit = [""], int((wide - 2 * _PAD) / _CODE_LETTER)
    for part in re.findall(r"[^._]*[._]*", code):
        if lines[-1] and len(lines[-1]) + len(part) > limit:
            lines.append("")
        lines[-1] += part
    return fill(text, int((wide - 2 * _PAD) / _LETTER)), "\n".join(lines)


def _height(text: str, code: str) -> float:
    rows = text.count("\n") + 1 + (code.count("\n") + 1 if code else 0)
    return rows * _LINE + 2 * _PAD


def _write(ax: Any, centre: tuple[float, float], text: str, code: str, name: str) -> None:
    """Text above code, in the middle of a box."""
    x, y = centre
    below = _LINE * (code.count("\n") + 1) if code else 0.0
    above = _LINE * (text.count("\n") + 1)
    ax.text(x, y + 0.5 * below, text, ha="center", va="center", linespacing=1.15, gid=f"box-{name}")
    if code:
        ax.text(x, y - 0.5 * above, code, ha="center", va="center", family="monospace", fontsize=8,
                linespacing=1.3, gid=f"box-{name}")  # fmt: skip


def _box(
    ax: Any, centre: tuple[float, float], size: tuple[float, float], color: str, name: str
) -> None:
    corner = centre[0] - 0.5 * size[0], centre[1] - 0.5 * size[1]
    ax.add_patch(FancyBboxPatch(corner, *size, boxstyle="round,pad=0,rounding_size=0.07",
                                facecolor=color + "1a", edgecolor=color, lw=1.4,
                                gid=f"box-{name}"))  # fmt: skip


def _elbow(ax: Any, start: tuple[float, float], end: tuple[float, float]) -> None:
    """An arrow between columns that goes through the gap between them."""
    middle = end[0] - 0.22
    places = [start, (middle, start[1]), (middle, end[1])]
    for a, b in pairwise(places):
        ax.plot([a[0], b[0]], [a[1], b[1]], color=BLACK, lw=1.2)
    _arrow(ax, places[-1], end)


def _arrow(ax: Any, start: tuple[float, float], end: tuple[float, float]) -> None:
    ax.annotate("", end, start, arrowprops={
        "arrowstyle": "-|>", "color": BLACK, "lw": 1.2, "shrinkA": 0, "shrinkB": 0})  # fmt: skip


def _title(step: Callable[..., Any]) -> str:
    return (step.__doc__ or step.__name__).splitlines()[0].rstrip(".")
