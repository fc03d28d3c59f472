"""Curves over one coordinate, which are sums of terms whose gains a reader can change."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError
from ..page import Page
from ..rendering import render
from ..style import BLUE, GREEN, ORANGE, PURPLE, RED
from .axis import Axis
from .data import compact, rounded

_COLORS = (BLUE, RED, GREEN, PURPLE, ORANGE)
_WIDTH, _HEIGHT = 720, 380
_LEFT, _TOP, _BOTTOM = 64, 30, 52
_LETTER = 7.2  # width of a letter of a label [pixel]
_LINE = 16.0  # least distance of two labels [pixel]


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve y = sum_t gain_t * terms[t] over the common coordinate.

    Attributes
    ----------
    terms : mapping of str to ndarray (N,)
        The names of gains, or any other names for terms that stay as they are.
    dashed : bool
        For what is only there to compare with.
    """

    name: str
    terms: Mapping[str, np.ndarray]
    dashed: bool = False


def curve_slice(
    title: str,
    x: ArrayLike,
    curves: Sequence[Curve],
    *,
    x_label: str,
    y_label: str,
    gains: Mapping[str, float] | None = None,
    marks: Mapping[str, float] | None = None,
    levels: Mapping[str, float] | None = None,
    names: Sequence[str] | None = None,
    y_range: tuple[float, float] | None = None,
    minima: bool = False,
) -> Page:
    """Curves with a marker that follows the pointer or the arrow keys, and a slider for each gain.

    Without scripts it is the drawing itself, with the gains as given.

    Parameters
    ----------
    x : (N,)
        Increasing.
    gains
        Name of a term to the value that its sliders start with; its term is that of gain one, and
        the slider goes from zero to three times the value.
    marks, levels
        Name to a place on x, and to a height, that is marked.
    names
        Text for each x, read out with the values, such as the closest pair.
    y_range
        Heights shown; default what the curves take.
    minima
        Whether the inner minima of each curve are circled, live.

    Raises
    ------
    InputError
        Lengths that do not fit, or x that does not increase.
    """
    places, gains = np.asarray(x, dtype=float), dict(gains or {})
    _check(places, curves, names)
    heights = [_sum(curve, gains) for curve in curves]
    low, high = y_range or _range(heights, (levels or {}).values())
    room = 14 + _LETTER * max(len(curve.name) for curve in curves)
    right = _WIDTH - min(room, 0.34 * _WIDTH)
    across = Axis(x_label, float(places[0]), float(places[-1]), _LEFT, right)
    up = Axis(y_label, low, high, _HEIGHT - _BOTTOM, _TOP)
    colors = [_COLORS[k % len(_COLORS)] for k in range(len(curves))]
    drawn = [
        {
            "name": curve.name,
            "color": color,
            "dashed": curve.dashed,
            "points": " ".join(
                f"{across.at(a)},{up.at(b)}" for a, b in zip(places, height, strict=True)
            ),
            "minima": [(across.at(places[k]), up.at(height[k])) for k in _minima(height)]
            if minima
            else [],
        }
        for curve, color, height in zip(curves, colors, heights, strict=True)
    ]
    ends = _apart([up.at(float(np.clip(h[-1], low, high))) for h in heights])
    data = {
        "x": rounded(places),
        "curves": [
            {"name": c.name, "terms": {n: rounded(v) for n, v in c.terms.items()}} for c in curves
        ],
        "gains": gains,
        "axes": [
            [low_, high_, start, end] for low_, high_, start, end in (_ends(across), _ends(up))
        ],
        "names": list(names) if names is not None else None,
        "minima": minima,
        "labels": [x_label, y_label],
    }
    html = render(
        "slice_curves",
        title=title,
        width=_WIDTH,
        height=_HEIGHT,
        across=across,
        up=up,
        curves=drawn,
        ends=ends,
        marks=[(name, across.at(value)) for name, value in (marks or {}).items()],
        levels=[(name, up.at(value)) for name, value in (levels or {}).items()],
        data=compact(data),
    )
    return Page(str(html))


def _check(places: np.ndarray, curves: Sequence[Curve], names: Sequence[str] | None) -> None:
    if places.ndim != 1 or len(places) < 2 or not (np.diff(places) > 0).all():
        raise InputError("curve_slice", "x", places.shape, "two or more increasing numbers")
    for curve in curves:
        for name, values in curve.terms.items():
            if np.shape(values) != places.shape:
                raise InputError(
                    f"curve {curve.name}", f"shape of {name}", np.shape(values), str(places.shape)
                )
    if names is not None and len(names) != len(places):
        raise InputError("curve_slice", "names", len(names), f"{len(places)} texts")


def _sum(curve: Curve, gains: Mapping[str, float]) -> np.ndarray:
    parts = [gains.get(name, 1.0) * np.asarray(v, float) for name, v in curve.terms.items()]
    return np.sum(parts, axis=0)


def _range(heights: Sequence[np.ndarray], levels: object) -> tuple[float, float]:
    every = np.concatenate([*heights, np.array(list(levels), dtype=float)])  # type: ignore[call-overload]
    low, high = float(every.min()), float(every.max())
    pad = 0.05 * (high - low or 1.0)
    return low - pad, high + pad


def _minima(height: np.ndarray) -> list[int]:
    """Indices of inner minima."""
    inner = (height[1:-1] < height[:-2]) & (height[1:-1] <= height[2:])
    return (np.flatnonzero(inner) + 1).tolist()


def _apart(heights: Sequence[float]) -> list[float]:
    """Heights of labels, moved down where two would overlap."""
    order, placed = np.argsort(heights), [0.0] * len(heights)
    last = -np.inf
    for k in order:
        last = placed[k] = max(float(heights[k]), last + _LINE)
    return placed


def _ends(axis: Axis) -> tuple[float, float, float, float]:
    return axis.low, axis.high, axis.start, axis.end
