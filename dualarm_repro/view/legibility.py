"""What keeps a figure from being read: letters too small, outside or over each other, bare axes."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import numpy as np
from matplotlib.text import Text
from matplotlib.ticker import NullLocator
from matplotlib.transforms import Bbox

from .style import PAD, PAGE_PX, SMALL

#: How far two texts, or a text and the edge of its box, may overlap [pt].
_SLACK = 1.5
#: A quantity in an axis label is followed by its unit, or has none.
_COUNTED = (
    "share", "step", "seam point", "generation", "iteration", "search", "sample", "fitness",
    "penalty", "violation", "error", "residual", "active rows", "runs of 10", "gap", "coordinate",
    "objective", "manipulability", "optimiser", "assumption", "eta_0", "weight",
)  # fmt: skip


def faults(figure: Any, page_px: float = PAGE_PX) -> list[str]:
    """What is wrong with a figure that is shown in a column of ``page_px`` CSS pixels.

    Letters below 8 pt there; text beyond the paper; two texts over each other; a text that leaves
    its box (``gid`` "box-..." of a patch and of the text in it); axes without a name, or with a
    name that tells neither a unit nor a quantity without one.
    """
    figure.draw_without_rendering()
    texts = list(_texts(figure))
    return [
        *_small(figure, texts, page_px),
        *_outside(figure, texts),
        *_over_each_other(figure, texts),
        *_out_of_box(figure, texts),
        *_unnamed(figure),
    ]


def _texts(figure: Any) -> Iterator[tuple[Text, Bbox]]:
    """Texts that are drawn, with their place [px]."""
    hidden = set(_not_drawn(figure))
    for text in figure.findobj(Text):
        if id(text) in hidden or not text.get_text().strip() or not text.get_visible():
            continue
        box = Text.get_window_extent(text)
        if np.isfinite(box.extents).all():
            yield text, box


def _not_drawn(figure: Any) -> Iterator[int]:
    """Labels of ticks beyond the limits, and what belongs to axes that are switched off."""
    for ax in figure.axes:
        if not ax.get_visible():
            yield from map(id, ax.findobj(Text))
        for axis in ax._axis_map.values():
            off = not (ax.axison and axis.get_visible())
            drawn = [] if off else axis._update_ticks()
            for tick in (*axis.majorTicks, *axis.minorTicks):
                if tick not in drawn:
                    yield from (id(tick.label1), id(tick.label2))
            if off:
                yield from (id(axis.label), id(axis.offsetText))


def _small(figure: Any, texts: list[tuple[Text, Bbox]], page_px: float) -> Iterator[str]:
    width = 96 * (figure.get_tightbbox().width + 2 * PAD)
    scale = min(1.0, page_px / width)
    for text, _ in texts:
        size = scale * text.get_fontsize()
        if size < SMALL - 0.05:
            yield f"{_short(text)} has {size:.1f} pt at the width of the page"


def _outside(figure: Any, texts: list[tuple[Text, Bbox]]) -> Iterator[str]:
    # Saved is what the drawing takes, which may be more than the paper.
    paper = figure.get_tightbbox().transformed(figure.dpi_scale_trans)
    for text, box in texts:
        if _cut(text, box) > _slack(figure):
            yield f"{_short(text)} is clipped"
        elif _sticks_out(box, paper) > _slack(figure):
            yield f"{_short(text)} leaves the paper"


def _cut(text: Text, box: Bbox) -> float:
    """How much of a text lies beyond what clips it [px]."""
    clip = text.get_clip_box() if text.get_clip_on() else None
    return 0.0 if clip is None else _sticks_out(box, clip)


def _over_each_other(figure: Any, texts: list[tuple[Text, Bbox]]) -> Iterator[str]:
    frames = [_frame(text, box) for text, box in texts]
    for (one, first), (other, second) in combinations(zip(texts, frames, strict=True), 2):
        if Bbox.intersection(one[1], other[1]) and _common(first, second) > _slack(figure):
            yield f"{_short(one[0])} and {_short(other[0])} overlap"


def _frame(text: Text, box: Bbox) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Centre, half sides and axes of the rectangle around a text, turned as it is."""
    turn = text.get_rotation()
    text.set_rotation(0)
    level = Text.get_window_extent(text)
    text.set_rotation(turn)
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    centre = np.array([0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)])
    return centre, 0.5 * np.array([level.width, level.height]), np.array([[c, s], [-s, c]])


def _common(
    one: tuple[np.ndarray, np.ndarray, np.ndarray], other: tuple[np.ndarray, np.ndarray, np.ndarray]
) -> float:
    """How deep two rectangles lie in each other, by their separating axes [px]."""
    (a, half_a, axes_a), (b, half_b, axes_b) = one, other
    depths = [
        np.abs(axes_a @ axis) @ half_a + np.abs(axes_b @ axis) @ half_b - abs((b - a) @ axis)
        for axis in (*axes_a, *axes_b)
    ]
    return float(min(depths))


def _out_of_box(figure: Any, texts: list[tuple[Text, Bbox]]) -> Iterator[str]:
    boxes = {
        patch.get_gid(): patch
        for ax in figure.axes
        for patch in ax.patches
        if str(patch.get_gid()).startswith("box-")
    }
    for text, extent in texts:
        patch = boxes.get(text.get_gid() or "")
        if patch is None:
            continue
        outline = patch.get_transform().transform_path(patch.get_path())
        grown = extent.padded(-_slack(figure))
        if not outline.contains_points(grown.corners()).all():
            yield f"{_short(text)} leaves its box"


def _unnamed(figure: Any) -> Iterator[str]:
    for ax in figure.axes:
        if not ax.axison or not ax.get_visible():
            continue
        for name, axis in ax._axis_map.items():
            if not _ticked(axis):
                continue
            label = axis.get_label_text().strip()
            if not _numeric(axis):
                continue  # names explain themselves
            if not label:
                yield f"the {name} axis has no name"
            elif "[" not in label and not _is_counted(label):
                yield f'the {name} axis "{label}" has no unit'


def _ticked(axis: Any) -> bool:
    """Whether numbers stand at the axis; of shared axes only one of them has them."""
    if not axis.get_visible() or isinstance(axis.get_major_locator(), NullLocator):
        return False
    return any(t.get_text().strip() and t.get_visible() for t in axis.get_ticklabels())


def _numeric(axis: Any) -> bool:
    labels = [t.get_text().strip() for t in axis.get_ticklabels()]
    return any(label[:1].isdigit() or label[:1] in "−-$." for label in labels if label)


def _is_counted(label: str) -> bool:
    return any(word in label.lower() for word in _COUNTED)


def _sticks_out(inner: Bbox, outer: Bbox) -> float:
    return float(max(outer.x0 - inner.x0, inner.x1 - outer.x1,
                     outer.y0 - inner.y0, inner.y1 - outer.y1))  # fmt: skip


def _slack(figure: Any) -> float:
    return _SLACK * float(figure.dpi) / 72


def _short(text: Text) -> str:
    return repr(text.get_text()[:40])
