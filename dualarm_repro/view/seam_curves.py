"""Curves along a seam: manipulabilities and joint angles of the three robots."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from ..welding import ROBOTS, Cell, Measures
from .ellipsoids import ROBOT_COLORS
from .style import BLACK, PURPLE, house_style


def measures_figure(curves: Mapping[str, tuple[np.ndarray, Measures]]) -> Any:
    """Measures of each robot, w (3, N), of the carriers and of the system, one panel a name."""
    with house_style():
        figure, axes = plt.subplots(
            1, len(curves), figsize=(5.4 * len(curves), 4.2), sharey=True, squeeze=False
        )
        for ax, (title, (w, measures)) in zip(axes[0], curves.items(), strict=True):
            for name, color, values in zip(ROBOTS, ROBOT_COLORS, w, strict=True):
                ax.plot(values, color=color, label=f"{name} [m³]")
            ax.plot(measures.tight, color=PURPLE, ls="--", label="carriers together [m⁶]")
            ax.plot(measures.system, color=BLACK, lw=2.5, label="system, (16)")
            ax.set(title=title, xlabel="seam point", ylabel="manipulability", ylim=(0, None))
            ax.margins(x=0)
        figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def joints_figure(cell: Cell, q: np.ndarray) -> Any:
    """Joint angles q (3, N, 6) of each robot in degrees, with the share of the range they use."""
    with house_style():
        figure, axes = plt.subplots(1, 3, figsize=(12, 4.4), sharey=True)
        for k, (ax, name) in enumerate(zip(axes, ROBOTS, strict=True)):
            lower, upper = np.degrees(cell.limits(k))
            for j in range(6):
                angle = np.degrees(q[k, :, j])
                label = f"q{j + 1} in [{lower[j]:.0f}, {upper[j]:.0f}]"
                ax.plot(angle, label=label)
            ax.set(title=name, xlabel="seam point", ylabel="joint angle [deg]")
            ax.margins(x=0)
        figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=6)
    return figure
