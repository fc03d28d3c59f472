"""A table of shares by row and column, each cell with its interval, shaded by its value."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from ..ledger.shares import Share
from .style import FIXED_BLACK, FIXED_WHITE, SMALL, WIDTH, house_style

_ROW = 0.48  # height of a row [in]
_DARK = 0.55  # share from which letters on its cell are light


def share_matrix_figure(
    rows: Mapping[str, Mapping[str, Share]], scale: str, beside: Mapping[str, str] | None = None
) -> Any:
    """Cells (R, C) with the share in percent above its interval.

    Parameters
    ----------
    scale
        What the shares are of, with its unit: the title of the columns.
    beside
        A second line for the name of a row.
    """
    columns = list(next(iter(rows.values())))
    with house_style():
        tall = _ROW * (len(rows) + 1) + 1.3
        figure, ax = plt.subplots(figsize=(WIDTH, tall))
        values = np.array([[row[name].value for name in columns] for row in rows.values()])
        ax.imshow(values, cmap="Blues", vmin=0.0, vmax=1.0, aspect="auto")
        for (i, j), value in np.ndenumerate(values):
            share = list(rows.values())[i][columns[j]]
            text = f"{100 * value:.0f}\n{100 * share.low:.0f}-{100 * share.high:.0f}"
            color = FIXED_WHITE if value > _DARK else FIXED_BLACK
            ax.text(j, i, text, ha="center", va="center", color=color, fontsize=SMALL + 0.5)
        ax.set_xticks(range(len(columns)), columns, fontsize=SMALL + 0.5)
        second = beside or {}
        names = [f"{name}\n{second[name]}" if name in second else name for name in rows]
        ax.set_yticks(range(len(rows)), names, fontsize=SMALL + 0.5)
        ax.xaxis.tick_top()
        ax.tick_params(length=0)
        ax.set_xlabel(scale)
        ax.grid(visible=False)
    return figure
