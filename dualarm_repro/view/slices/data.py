"""What a slice hands to its script."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from markupsafe import Markup

#: Significant digits; a drawing shows three.
_DIGITS = 5


def rounded(values: np.ndarray) -> list[float]:
    """Numbers with five significant digits."""
    return [float(f"{float(value):.{_DIGITS}g}") for value in np.asarray(values).ravel()]


def compact(data: dict[str, Any]) -> Markup:
    """Short JSON that may stand inside a script element."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    return Markup(text.replace("</", "<\\/"))
