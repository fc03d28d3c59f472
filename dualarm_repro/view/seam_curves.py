"""Curves along a seam: manipulabilities and joint angles of the three robots."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from ..welding import ROBOTS, Cell, Measures
from .ellipsoids import ROBOT_COLORS
from .labels import name_ends
from .style import BLACK, PALETTE, PURPLE, WIDTH, house_style


def measures_figure(curves: Mapping[str, tuple[np.ndarray, Measures]]) -> Any:
    """Measures of each robot, w (3, N), of the carriers and of the system, one panel a name."""
    with house_style():
        figure, axes = plt.subplots(
            1, len(curves), figsize=(WIDTH, 4.0), sharey=True, squeeze=False
        )
        for ax, (title, (w, measures)) in zip(axes[0], curves.items(), strict=True):
            for name, color, values in zip(ROBOTS, ROBOT_COLORS, w, strict=True):
                ax.plot(values, color=color, label=f"{name} [m³]")
            ax.plot(measures.tight, color=PURPLE, ls="--", label="both carriers [m⁶]")
            ax.plot(measures.system, color=BLACK, lw=2.5, label="system, (16)")
            ax.set(title=title, xlabel="seam point")
            ax.margins(x=0)
        axes[0, 0].set(ylabel="manipulability", ylim=(0, None))  # after all panels: they share it
        name_ends(axes[0, -1])
    return figure


def joints_figure(cell: Cell, q: np.ndarray) -> Any:
    """Joint angles q (3, N, 6) of each robot in degrees; the legend gives their limits."""
    with house_style():
        figure, axes = plt.subplots(1, 3, figsize=(WIDTH, 4.6), sharey=True)
        for k, (ax, name) in enumerate(zip(axes, ROBOTS, strict=True)):
            lower, upper = np.degrees(cell.limits(k))
            for j in range(6):
                angle = np.degrees(q[k, :, j])
                label = f"q{j + 1} in [{lower[j]:.0f}, {upper[j]:.0f}]"
                ax.plot(angle, label=label, color=PALETTE[j], lw=1.8)
                for limit in (lower[j], upper[j]):  # seen where the range of the panel holds it
                    ax.plot([0.0, 0.06], [limit, limit], color=PALETTE[j], lw=3, zorder=1,
                            scaley=False, transform=ax.get_yaxis_transform())  # fmt: skip
            ax.set(title=name, xlabel="seam point")
            ax.margins(x=0)
        axes[0].set_ylabel("joint angle [deg]")
        figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper left", ncols=3,
                      title="joints, and their limits in degrees (bars at the left)",
                      alignment="left")  # fmt: skip
    return figure


def rates_figure(used: np.ndarray, fastest: float) -> Any:
    """Largest joint speed of each robot over its limit, at the fastest pace of the torch.

    Parameters
    ----------
    used : ndarray (3, N, 6)
        dq/ds over the speed limit of the joint [s/m].
    fastest : float
        Pace of the torch along the seam [m/s].
    """
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 3.4))
        share = fastest * abs(used).max(axis=2)
        for name, color, values in zip(ROBOTS, ROBOT_COLORS, share, strict=True):
            ax.plot(values, color=color, label=name)
        ax.axhline(1.0, color=BLACK, lw=0.9, ls="--", label="limit")
        pace = f"share of the speed limit\nat {1e3 * fastest:.0f} mm/s along the seam"
        ax.set(xlabel="seam point", ylabel=pace, ylim=(0, 1.08))
        ax.margins(x=0)
        name_ends(ax)
    return figure
