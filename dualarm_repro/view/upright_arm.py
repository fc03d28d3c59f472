"""Side view of a six-joint arm in the upright posture of a maker's drawing, with its lengths."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .arm_drawings import dimension_drawing

#: Each length of a DH table by direction (x, z) and the offset of its dimension line [m].
_STEPS = {
    "d1": ((0.0, 1.0), (-0.25, 0.0)),
    "a1": ((1.0, 0.0), (0.0, -0.15)),
    "a2": ((0.0, 1.0), (0.25, 0.0)),
    "a3": ((0.0, 1.0), (-0.25, 0.0)),
    "d4": ((1.0, 0.0), (0.0, 0.15)),
    "d6": ((1.0, 0.0), (0.0, -0.15)),
}


def upright_drawing(size: Mapping[str, float]) -> Any:
    """Base, axes S, L and U, corner, wrist and flange: upper arm upright, forearm level.

    Parameters
    ----------
    size
        Lengths d1, a1, a2, a3, d4 and d6 [m].
    """
    outline = [np.zeros(2)]
    for name, (along, _) in _STEPS.items():
        outline.append(outline[-1] + size[name] * np.array(along))
    dimensions = [
        (name, outline[k], outline[k + 1], offset)
        for k, (name, (_, offset)) in enumerate(_STEPS.items())
    ]
    return dimension_drawing(np.array(outline), dimensions)
