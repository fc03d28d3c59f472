"""Energy of motions over their mean joint speed."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from .style import BLUE, WIDTH, house_style

_NAMES = {
    "work": "work of the drives [J]",
    "driven": "driving work [J]",
    "heat": "integral of squared torque [N$^2$m$^2$s]",
}


def effort_figure(speed: np.ndarray, energy: np.ndarray, measure: str) -> Any:
    """A point for each motion: mean joint speed (N,) [rad/s] and energy (N,) of a measure."""
    with house_style():
        figure, ax = plt.subplots(figsize=(WIDTH, 3.8))
        ax.plot(speed, energy, ".", color=BLUE, ms=4, alpha=0.6)
        ax.set(xlabel="mean joint speed [rad/s]", ylabel=_NAMES[measure], ylim=(0, None))
    return figure
