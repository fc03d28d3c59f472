"""Which constants of a chain are 0 or 1: what its programs are generated for.

Chains of one structure share their programs and their machine code; the other constants are an
argument. So arms that differ in lengths compile nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..chain import Chain, SlidingChain
from .program import ONE, ZERO, Term, Vector

#: Entries of rotations, and lengths as a share of the longest, that count as 0; and 1 likewise.
ROUNDING = 1e-15


class Structure(NamedTuple):
    """Of every constant C_0 ... C_n its rotation (row by row) and its translation as terms, and
    whether each joint slides; the terms ``k0``, ``k1`` ... stand for :class:`Constants`."""

    rotations: tuple[tuple[Vector, Vector, Vector], ...]
    translations: tuple[Vector, ...]
    slides: tuple[bool, ...]

    @property
    def joints(self) -> int:
        """Number n of joints."""
        return len(self.slides)


class Constants:
    """Numbers of a chain or a point, sorted into those that are 0 or 1 and those that have a name.

    Attributes
    ----------
    values : list of float
        Of the terms ``k0``, ``k1`` ... in this order.
    """

    def __init__(self) -> None:
        self.values: list[float] = []

    def term(self, value: float, scale: float = 1.0, unit: bool = False) -> Term:
        """0 for what is round-off of the scale, 1 and -1 if ``unit``, else a new name."""
        if abs(value) <= ROUNDING * scale:
            return ZERO
        if unit and abs(abs(value) - 1.0) <= ROUNDING:
            return ONE if value > 0 else -ONE
        self.values.append(float(value))
        return Term(1, f"k{len(self.values) - 1}")

    def vector(self, values: Sequence[float] | np.ndarray, scale: float) -> Vector:
        """Three lengths [m]."""
        return tuple(self.term(value, scale) for value in values)


def structure_of(chain: Chain | SlidingChain, constants: Constants) -> Structure:
    """The structure of a chain; ``constants`` takes up what is neither 0 nor 1."""
    scale = float(np.abs(chain.translation).max(initial=0.0))
    rotations, translations = [], []
    for rotation, translation in zip(chain.rotation, chain.translation, strict=True):
        rows = [tuple(constants.term(x, unit=True) for x in row) for row in rotation]
        rotations.append((rows[0], rows[1], rows[2]))
        translations.append(constants.vector(translation, scale))
    slides = getattr(chain, "slides", np.zeros(len(rotations) - 1, dtype=bool))
    return Structure(tuple(rotations), tuple(translations), tuple(slides.tolist()))
