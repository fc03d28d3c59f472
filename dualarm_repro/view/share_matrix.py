"""A table of shares by row and column, each cell with its interval, shaded by its value."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from ..ledger.shares import Share
from .style import FIXED_BLACK, FIXED_WHITE, SMALL, WIDTH, house_style

_ROW, _LEFT = 0.36, 0.5  # height of a row, and of the rows above the cells [in]
_DARK = 0.55  # share from which letters on its cell are light


def share_matrix_figure(
    rows: Mapping[str, Mapping[str, Share]], scale: str, beside: Mapping[str, str] | None = None
) -> Any:
    """Cells (R, C) with "share (low-high)" in percent; ``beside`` adds a last column of text.

    Parameters
    ----------
    scale
        What the shares are of, with its unit: the title of the columns.
    """
    columns = list(next(iter(rows.values())))
    with house_style():
        tall = _ROW * (len(rows) + 1) + 1.3
        figure, ax = plt.subplots(figsize=(WIDTH, tall))
        values = np.array([[row[name].value for name in columns] for row in rows.values()])
        ax.imshow(values, cmap="Blues", vmin=0.0, vmax=1.0, aspect="auto")
        for (i, j), value in np.ndenumerate(values):
            share = list(rows.values())[i][columns[j]]
            text = f"{100 * value:.0f} ({100 * share.low:.0f}-{100 * share.high:.0f})"
            color = FIXED_WHITE if value > _DARK else FIXED_BLACK
            ax.text(j, i, text, ha="center", va="center", color=color, fontsize=SMALL + 0.5)
        ax.set_xticks(range(len(columns)), columns, fontsize=SMALL + 0.5)
        ax.set_yticks(range(len(rows)), list(rows), fontsize=SMALL + 0.5)
        ax.xaxis.tick_top()
        ax.tick_params(length=0)
        ax.set_xlabel(scale)
        ax.grid(visible=False)
        for k, name in enumerate(rows):
            if beside and name in beside:
                ax.annotate(
                    beside[name], (1.01, k), xycoords=("axes fraction", "data"), va="center",
                    fontsize=SMALL + 0.5,
                )  # fmt: skip
    return figure
