"""Files of one item: JSON, CSV, SVG, PNG and, where there is one, the 3-D scene as HTML."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pandas as pd

from .evaluation import Evaluation
from .files import to_json, write, write_text
from .finding import entitled
from .printed import leaves

#: Fixed so that the same figure gives the same SVG; matplotlib else draws a random salt.
_SVG_SALT = "dualarm_repro"


def export(
    evaluation: Evaluation,
    made: dict[str, Any],
    folder: Path,
    card: Callable[[dict[str, Any]], Any],
) -> list[Path]:
    """Write the files of an item.

    Parameters
    ----------
    evaluation
        The evaluated item, whose result may draw a figure and a scene.
    made
        Its record.
    folder
        Made if needed.
    card
        Draws the record as a figure, for items that have none of their own.

    Raises
    ------
    OutputError
        The folder cannot be written.
    """
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    name, result = evaluation.item_id, evaluation.result
    written = [write_text(folder / f"{name}.json", to_json(made))]
    table = data_table(evaluation, made)
    written.append(write_text(folder / f"{name}.csv", table.to_csv(index=False)))
    if result and result.figure:
        figure = entitled(result.figure(), result.told())
    else:
        figure = card(made)
    try:
        with mpl.rc_context({"svg.hashsalt": _SVG_SALT}):
            for suffix, extra in ((".svg", {"metadata": {"Date": None}}), (".png", {"dpi": 160})):

                def save(path: Path, extra: dict[str, Any] = extra) -> None:
                    figure.savefig(path, bbox_inches="tight", **extra)

                written.append(write(folder / f"{name}{suffix}", save))
    finally:
        plt.close(figure)
    if result and result.scene:
        written.append(write_text(folder / f"{name}.html", result.scene().html()))
    return written


def data_table(evaluation: Evaluation, made: dict[str, Any]) -> pd.DataFrame:
    """The data behind an item: its own table, or the obtained values one a row."""
    if evaluation.result is not None and evaluation.result.table is not None:
        return evaluation.result.table
    rows = [(".".join(map(str, path)), leaf) for path, leaf in leaves(made["obtained"] or {})]
    return pd.DataFrame(rows, columns=["quantity", "value"])
