"""The variants of the search by potential fields: every combination of its three improvements."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product


@dataclass(frozen=True)
class Variant:
    """Which of the three improvements a search uses."""

    variable_gain: bool = True
    adaptive_step: bool = True
    two_sided: bool = True

    @property
    def name(self) -> str:
        """``traditional``, or the letters of the improvements: V gain, A step, B both ends."""
        letters = zip("VAB", (self.variable_gain, self.adaptive_step, self.two_sided), strict=True)
        return "".join(letter for letter, on in letters if on) or "traditional"


TRADITIONAL, IMPROVED = Variant(False, False, False), Variant()
#: All eight, the one-sided ones first.
VARIANTS = tuple(Variant(gain, step, both) for both, gain, step in product((False, True), repeat=3))
