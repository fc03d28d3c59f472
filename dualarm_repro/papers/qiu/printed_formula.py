"""Values of printed formulas, for comparison with what the code computes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...errors import DataFileError
from ...ledger.formula import Formula


def value_of(formula: Formula, side: int, given: Mapping[str, Any]) -> Any:
    """Value of one side; NaN where there is no such side or it holds other names than the code."""
    try:
        return formula.value(side, given)
    except (DataFileError, IndexError, TypeError, ValueError):
        return np.nan
