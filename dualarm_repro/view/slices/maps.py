"""A quantity in a plane, in several layers, with its value under the pointer."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError
from ..page import Page
from ..rendering import render
from .axis import Axis
from .data import compact

_WIDTH, _LEFT, _TOP, _BOTTOM, _RIGHT = 720, 70, 16, 52, 110
_NONE = 255  # the value of a cell that has none
_TALLEST = 460.0


@dataclass(frozen=True, eq=False)
class Layer:
    """One picture of the plane.

    Attributes
    ----------
    name : str
        Such as ``"z = 0.45 m"``.
    values : ndarray (M, N)
        At M places up and N across; NaN where there is none.
    marks : mapping of str to (x, y)
        Named points of this layer.
    """

    name: str
    values: np.ndarray
    marks: Mapping[str, tuple[float, float]]


def map_slice(
    title: str,
    across: tuple[str, ArrayLike],
    up: tuple[str, ArrayLike],
    layers: Sequence[Layer],
    *,
    quantity: str,
    shown: int = 0,
    ordered: bool = False,
    value_range: tuple[float, float] | None = None,
    nothing: str = "no value",
) -> Page:
    """Layers of a map with one scale of colours; pointer or arrow keys read a value out.

    Without scripts the layer ``shown`` is a picture.

    Parameters
    ----------
    across, up
        Label and increasing, equally spaced places (N,) and (M,).
    quantity
        What is drawn, with its unit.
    ordered
        Whether the layers follow one another, for a slider instead of buttons.
    nothing
        What a cell without a value means.

    Raises
    ------
    InputError
        A layer of another shape.
    """
    x, y = (np.asarray(places, dtype=float) for _, places in (across, up))
    for layer in layers:
        if np.shape(layer.values) != (len(y), len(x)):
            expected = f"({len(y)}, {len(x)})"
            raise InputError(f"layer {layer.name}", "shape", np.shape(layer.values), expected)
    low, high = value_range or _range(layers)
    width = _WIDTH - _LEFT - _RIGHT
    height = width * (y[-1] - y[0]) / (x[-1] - x[0])
    if height > _TALLEST:
        width, height = width * _TALLEST / height, _TALLEST
    half_x, half_y = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    bottom = _TOP + height
    horizontal = Axis(across[0], x[0] - half_x, x[-1] + half_x, _LEFT, _LEFT + width)
    vertical = Axis(up[0], y[0] - half_y, y[-1] + half_y, bottom, _TOP)
    scale = Axis(quantity, low, high, bottom, _TOP)
    whole = [_whole(np.asarray(layer.values, dtype=float), low, high) for layer in layers]
    table = _colors()
    data = {
        "x": [x[0], x[-1], len(x)],
        "y": [y[0], y[-1], len(y)],
        "range": [low, high],
        "layers": [
            {
                "name": layer.name,
                "v": b64encode(cells.tobytes()).decode(),
                "marks": [
                    [n, horizontal.at(a), vertical.at(b)] for n, (a, b) in layer.marks.items()
                ],
            }
            for layer, cells in zip(layers, whole, strict=True)
        ],
        "colors": b64encode(table.tobytes()).decode(),
        "axes": [[axis.low, axis.high, axis.start, axis.end] for axis in (horizontal, vertical)],
        "labels": [across[0], up[0], quantity],
        "nothing": nothing,
        "shown": shown,
    }
    html = render(
        "slice_map",
        title=title,
        width=_WIDTH,
        height=round(bottom + _BOTTOM),
        across=horizontal,
        up=vertical,
        scale=scale,
        bar=round(horizontal.end + 24),
        stops=[(k / 8, "#" + table[round(254 * k / 8)].tobytes().hex()) for k in range(9)],
        picture=_picture(whole[shown], table),
        layer=layers[shown],
        marks=[(n, horizontal.at(a), vertical.at(b)) for n, (a, b) in layers[shown].marks.items()],
        names=[layer.name for layer in layers],
        shown=shown,
        ordered=ordered,
        nothing=nothing if any((cells == _NONE).any() for cells in whole) else None,
        data=compact(data),
    )
    return Page(str(html))


def _range(layers: Sequence[Layer]) -> tuple[float, float]:
    every = np.concatenate([np.ravel(layer.values) for layer in layers])
    every = every[np.isfinite(every)]
    if not len(every):
        return 0.0, 1.0
    low, high = float(every.min()), float(every.max())
    return low, high if high > low else low + 1.0


def _whole(values: np.ndarray, low: float, high: float) -> np.ndarray:
    """Values as 0 ... 254 between low and high, rows from the top."""
    share = np.clip((values - low) / (high - low), 0.0, 1.0)
    cells = np.where(np.isfinite(values), np.round(254.0 * np.nan_to_num(share)), _NONE)
    return np.ascontiguousarray(cells[::-1].astype(np.uint8))


def _colors() -> np.ndarray:
    """Colours (255, 3) of the values."""
    from matplotlib import colormaps

    return np.round(255 * colormaps["viridis"](np.linspace(0, 1, 255))[:, :3]).astype(np.uint8)


def _picture(cells: np.ndarray, table: np.ndarray) -> str:
    from PIL import Image

    alpha = np.where(cells == _NONE, 0, 255).astype(np.uint8)[..., np.newaxis]
    pixels = np.concatenate([table[np.minimum(cells, 254)], alpha], axis=2)
    buffer = BytesIO()
    Image.fromarray(pixels, "RGBA").save(buffer, "PNG", optimize=True)
    return "data:image/png;base64," + b64encode(buffer.getvalue()).decode()
