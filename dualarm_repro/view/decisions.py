"""Flow chart with decisions: steps as boxes, questions with a way for yes and one for no."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from textwrap import fill
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
from matplotlib.patches import FancyBboxPatch, Polygon

from .style import BLUE, GREEN, ORANGE, RED, WIDTH, house_style, ink

_WIDE, _HIGH, _TIP = 2.0, 0.78, 0.2  # of a box, and of the tips of a question [in]
_LETTERS = 25  # of a line in a box
_COLUMN, _ROW = 2.67, 1.06  # from middle to middle [in]


class Node(NamedTuple):
    """A box at a column and a row, counted from the top; a question has two ways out."""

    text: str
    column: float
    row: float
    question: bool = False
    end: bool = False


class Way(NamedTuple):
    """An arrow along corners (column, row), from the edge of one node to that of another; what it
    is for stands at one of its pieces."""

    corners: Sequence[tuple[float, float]]
    name: str = ""
    piece: int = 0


def decisions_figure(nodes: Mapping[str, Node], ways: Sequence[Way]) -> Any:
    """The chart; the names of its ways, such as "yes (12)", stand beside them."""
    rows = max(node.row for node in nodes.values())
    tall = rows * _ROW + _HIGH + 0.16
    with house_style():
        figure = plt.figure(figsize=(WIDTH, tall), layout="none")
        ax = figure.add_axes((0, 0, 1, 1), xlim=(0, WIDTH), ylim=(0, tall))
        ax.axis("off")
        for k, node in enumerate(nodes.values()):
            _draw(ax, node, _place(node.column, node.row, tall), f"box-{k}")
        for way in ways:
            _arrow(ax, [_place(*corner, tall) for corner in way.corners], way.name, way.piece)
    return figure


def right_of(node: Node) -> tuple[float, float]:
    """The middle of the right edge of a node."""
    return node.column + 0.5 * _WIDE / _COLUMN, node.row


def left_of(node: Node) -> tuple[float, float]:
    """The middle of the left edge."""
    return node.column - 0.5 * _WIDE / _COLUMN, node.row


def above(node: Node) -> tuple[float, float]:
    """The middle of the upper edge."""
    return node.column, node.row - 0.5 * _HIGH / _ROW


def below(node: Node) -> tuple[float, float]:
    """The middle of the lower edge."""
    return node.column, node.row + 0.5 * _HIGH / _ROW


def _place(column: float, row: float, tall: float) -> tuple[float, float]:
    return 0.5 * _WIDE + 0.08 + column * _COLUMN, tall - 0.5 * _HIGH - 0.08 - row * _ROW


def _draw(ax: Any, node: Node, centre: tuple[float, float], name: str) -> None:
    (x, y), half, up = centre, 0.5 * _WIDE, 0.5 * _HIGH
    color = ORANGE if node.question else GREEN if node.end else BLUE
    style: dict[str, Any] = {"facecolor": color + "26", "edgecolor": color, "lw": 1.4, "gid": name}
    if node.question:
        tip = half - _TIP
        ax.add_patch(Polygon(
            [(x - half, y), (x - tip, y + up), (x + tip, y + up), (x + half, y), (x + tip, y - up),
             (x - tip, y - up)], **style))  # fmt: skip
    else:
        look = "round,pad=0,rounding_size=0.08"
        ax.add_patch(FancyBboxPatch((x - half, y - up), _WIDE, _HIGH, boxstyle=look, **style))
    letters = _LETTERS - 2 if node.question else _LETTERS
    ax.text(x, y, fill(node.text, letters), ha="center", va="center", fontsize=8.5,
            linespacing=1.15, gid=name)  # fmt: skip


def _arrow(ax: Any, corners: Sequence[tuple[float, float]], name: str, piece: int) -> None:
    for a, b in pairwise(corners[:-1]):
        ax.plot([a[0], b[0]], [a[1], b[1]], color="0.35", lw=1.3, solid_capstyle="butt")
    arrow = {"arrowstyle": "-|>", "color": "0.35", "lw": 1.3, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", corners[-1], corners[-2], arrowprops=arrow)
    if not name:
        return
    (x0, y0), (x1, y1) = corners[piece : piece + 2]
    level = abs(y1 - y0) < 1e-9
    reach = 0.5 * (x1 - x0)
    at = (x0 + max(min(reach, 0.33), -0.33), y0 + 0.04) if level else (x0 + 0.06, 0.5 * (y0 + y1))
    ax.text(*at, name, color=ink(RED), fontsize=8.5, weight="bold",
            ha="center" if level else "left", va="bottom" if level else "center")  # fmt: skip
