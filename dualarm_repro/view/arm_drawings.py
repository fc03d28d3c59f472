"""Drawings of arms: dimensioned side view, link frames, stick figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Unpack

import matplotlib.pyplot as plt
import numpy as np
import pinocchio as pin

from ..arms import Arm
from .style import BLACK, BLUE, GREEN, PALETTE, RED, View, axes_3d, house_style

_AXIS_COLORS = (RED, GREEN, BLUE)
_PAPER = {"facecolor": "white", "edgecolor": "none", "pad": 1}


def dimension_drawing(
    outline: np.ndarray,
    dimensions: Sequence[tuple[str, np.ndarray, np.ndarray, tuple[float, float]]],
) -> Any:
    """Side view of an arm in its vertical plane with dimensions in millimetres.

    Parameters
    ----------
    outline
        Points (N, 2) of the skeleton, (x, z) in metres.
    dimensions
        Name, two end points (x, z) and the offset of the dimension line, metres.
    """
    with house_style():
        figure, ax = plt.subplots(figsize=(6.6, 5.6))
        ax.plot(*outline.T, color=BLUE, lw=5, solid_capstyle="round", alpha=0.55)
        ax.plot(*outline.T, "o", color=BLACK, ms=5)
        for name, start, end, offset in dimensions:
            a, b = np.asarray(start) + offset, np.asarray(end) + offset
            for foot, tip in ((start, a), (end, b)):
                ax.plot(*np.array([foot, tip]).T, color="0.6", lw=0.7)
            arrow = {"arrowstyle": "<->", "color": BLACK, "lw": 1}
            ax.annotate("", (a[0], a[1]), (b[0], b[1]), arrowprops=arrow)
            text = f"{name} = {1000 * float(np.linalg.norm(b - a)):.0f}"
            # Beyond the line, so that a short dimension keeps its arrow.
            x, z = 0.5 * (a + b) + 0.5 * np.asarray(offset)
            ax.text(x, z, text, ha="center", va="center", bbox=_PAPER)
        ax.set(xlabel="x [m]", ylabel="z [m]", aspect="equal", title="dimensions in mm")
        ax.margins(0.3, 0.12)
    return figure


def frames_figure(frames: np.ndarray, length: float) -> Any:
    """Frames 0, 1, ... (N, 4, 4) as triads on the skeleton of an arm.

    Axes that coincide share one label ("z0 z1").
    """
    axes: dict[tuple[float, ...], list[str]] = {}
    for number, frame in enumerate(frames):
        for axis, letter in enumerate("xyz"):
            tip = frame[:3, 3] + length * frame[:3, axis]
            axes.setdefault((*tip.round(6), *frame[:3, 3].round(6)), []).append(f"{letter}{number}")
    with house_style():
        figure, ax = axes_3d(6.8, 6.2, elev=20, azim=-52)
        ax.plot(*frames[:, :3, 3].T, "o-", color="0.55", lw=4, ms=5)
        for place, names in axes.items():
            tip, origin = np.array(place[:3]), np.array(place[3:])
            color = _AXIS_COLORS["xyz".index(names[0][0])]
            ax.plot(*np.array([origin, tip]).T, color=color, lw=2)
            ax.text(*(origin + 1.25 * (tip - origin)), " ".join(names), color=color, ha="center")
        middle = frames[:, 1, 3].mean()
        ax.set_ylim(middle - 2 * length, middle + 2 * length)
        ax.set_aspect("equal")
    return figure


def stick_figure(arms: Mapping[str, tuple[Arm, np.ndarray, pin.SE3]], **view: Unpack[View]) -> Any:
    """Stick figure of arms: name to arm, configuration and placement of the base."""
    with house_style():
        figure, ax = axes_3d(**view)
        for color, (name, (arm, q, placement)) in zip(PALETTE[::3], arms.items(), strict=False):
            points = skeleton(arm, q, placement)
            ax.plot(*points.T, "o-", color=color, lw=4, ms=5, label=name)
            ax.plot(*points[-1:].T, "s", color=color, ms=8)
        ax.legend(loc="upper left")
        ax.set_aspect("equal")
    return figure


def skeleton(arm: Arm, q: np.ndarray, placement: pin.SE3) -> np.ndarray:
    """Base, joint origins and flange in the world (nq + 2, 3) [m]."""
    points = np.vstack([np.zeros(3), arm.joint_positions(q)])
    return points @ placement.rotation.T + placement.translation
