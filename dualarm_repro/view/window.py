"""Lengths at a window of four bars: its opening, and the way from a track to the nearest bar."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..scene import Box


def nearest_to_boxes(points: np.ndarray, boxes: Sequence[Box]) -> tuple[np.ndarray, np.ndarray]:
    """The point of a track (N, 3) that is nearest to a box, and the point of the box [m]."""
    best, ends = np.inf, (points[0], points[0])
    for box in boxes:
        local = (points - box.center) @ box.rotation
        on_box = local.clip(-box.half, box.half) @ box.rotation.T + box.center
        distance = np.linalg.norm(points - on_box, axis=1)
        k = int(distance.argmin())
        if distance[k] < best:
            best, ends = float(distance[k]), (points[k], on_box[k])
    return ends


def opening(bars: Sequence[Box]) -> tuple[np.ndarray, np.ndarray] | None:
    """Lower and upper corner (y, z) between four bars along the axes; None for other bars."""
    if len(bars) != 4:
        return None
    turned = np.array([np.abs(bar.rotation) for bar in bars])
    if np.abs(turned - turned.round()).max() > 1e-6:
        return None
    half = np.array([turn @ bar.half for turn, bar in zip(turned, bars, strict=True)])
    centre = np.array([bar.center for bar in bars])
    corners = []
    for axis in (1, 2):
        order = centre[:, axis].argsort()
        low, high = order[0], order[-1]
        corners.append((centre[low, axis] + half[low, axis], centre[high, axis] - half[high, axis]))
    if any(low >= high for low, high in corners):
        return None
    return np.array([c[0] for c in corners]), np.array([c[1] for c in corners])
