"""What the rate of a controller costs: tip error and distance over the step."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import pandas as pd

from .labels import name_ends
from .style import BLACK, WIDTH, house_style


def rate_figure(table: pd.DataFrame, bound: float) -> Any:
    """Largest tip error and smallest distance over the step, a line for each gain.

    Parameters
    ----------
    table
        Columns ``gamma [1/s]``, ``step [s]``, ``tip error [m]`` and ``distance [m]``.
    bound
        Tip error that counts as accurate [m].
    """
    with house_style():
        figure, axes = plt.subplots(2, 1, figsize=(WIDTH, 5.4), sharex=True)
        for k, (gamma, rows) in enumerate(table.groupby("gamma [1/s]")):
            style, steps = ("-", "--", ":")[k % 3], 1e3 * rows["step [s]"]
            label = f"gamma = {gamma:g} 1/s"
            axes[0].plot(steps, 1e6 * rows["tip error [m]"], style, marker="o", ms=4, label=label)
            axes[1].plot(steps, 1e3 * rows["distance [m]"], style, marker="o", ms=4, label=label)
        axes[0].axhline(1e6 * bound, color=BLACK, lw=0.9, label="called accurate")
        axes[0].set(ylabel="largest tip error [um]", yscale="log", xscale="log")
        axes[1].set(xlabel="step [ms]", ylabel="smallest distance [mm]")
        for ax in axes:
            name_ends(ax)
    return figure
