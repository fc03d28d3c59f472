"""How far the optimum of `pan` moves when one assumption at a time is changed."""

from __future__ import annotations

import numpy as np
import pandas as pd

from ...view.card import figure_html
from ...view.landscape import sensitivity_figure
from ...view.page import Page
from .scenario import printed_optimum
from .studies import SENSITIVITY


def sensitivity_table() -> pd.DataFrame:
    """Rows of the stored study with the displacement of the optimum, mirror images as one [m]."""
    table = SENSITIVITY.load()
    nominal = _folded(table.loc[table["assumption"] == "none", ["x", "y", "z"]].to_numpy())[0]
    points = _folded(table[["x", "y", "z"]].to_numpy())
    return table.assign(moved=np.linalg.norm(points - nominal, axis=1))


def sensitivities() -> Page:
    """The figure of the one-at-a-time study, for a page of the book."""
    table = sensitivity_table()
    nominal = table.loc[table["assumption"] == "none", ["x", "y", "z"]].to_numpy()[0]
    changed = table[table["assumption"] != "none"]
    largest = changed.groupby("assumption")["moved"].max().sort_values(ascending=False)
    ordered = changed.set_index("assumption").loc[largest.index].reset_index()
    still = [name for name, moved in largest.items() if moved < 0.005]
    infeasible = int(changed["fitness"].eq(0).sum())
    leading = ", ".join(
        f"{name.replace('_', ' ')} ({moved:.2f} m)" for name, moved in largest.head(4).items()
    )
    caption = (
        "Optimum when one assumption at a time takes other plausible values. It moves most with "
        f"{leading}. It does not move with "
        f"{', '.join(name.replace('_', ' ') for name in still) or 'none'}. {infeasible} of "
        f"{len(changed)} changes leave no feasible position."
    )
    alt = "Three panels with the coordinates of the optimum, one row for each assumption."
    figure = sensitivity_figure(ordered, nominal, printed_optimum())
    return Page(f'<div class="ledger-item">{figure_html(figure, alt, caption)}</div>')


def _folded(points: np.ndarray) -> np.ndarray:
    """The same with the sign of x dropped."""
    return np.column_stack([np.abs(points[:, 0]), points[:, 1:]])
