"""A table that a cell of the book ends in: numbers with as many digits as they deserve."""

from __future__ import annotations

from collections.abc import Mapping
from numbers import Integral, Real
from typing import Any

import numpy as np
import pandas as pd

from .page import Page


def table(frame: pd.DataFrame, formats: str | Mapping[str, str] = "{:.4g}") -> Page:
    """A frame for the reader, its index left out where it only counts the rows.

    Parameters
    ----------
    formats
        For every number, or for those of the columns named; the others have four digits. Whole
        numbers stay whole unless their column is named, a truth is yes or no, NaN an empty cell.
    """
    named = formats if isinstance(formats, Mapping) else {}
    default = "{:.4g}" if isinstance(formats, Mapping) else formats
    told = {
        column: [_told(value, named.get(column), default) for value in frame[column]]
        for column in frame
    }
    counted = isinstance(frame.index, pd.RangeIndex) and frame.index.name is None
    shown = pd.DataFrame(told, index=frame.index, columns=frame.columns)
    return Page(shown.to_html(index=not counted, border=0))


def _told(value: Any, wanted: str | None, default: str) -> str:
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    if not isinstance(value, Real):
        return str(value)
    if pd.isna(value):
        return ""
    if wanted is None and isinstance(value, Integral):
        return str(value)
    return (wanted or default).format(value)
