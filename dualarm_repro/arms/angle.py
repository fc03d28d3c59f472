"""Exact angles: what a robot file writes is kept as a rational number, of radians or of pi."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from typing import Any, NamedTuple

_DECIMAL = r"[+-]?\d+(?:\.\d+)?"
_DEGREES = re.compile(rf"({_DECIMAL})\s*deg")
_OF_PI = re.compile(r"([+-]?)(?:(\d+)\s*\*\s*)?pi(?:\s*/\s*(\d+))?")

LARGEST = (
    1e6  #: in radians, or in multiples of pi: of no larger angle is anything left of its turns
)
EXPECTED = 'an angle: a number in radians, "NN deg", or a multiple of pi such as "-pi/2"'


class Angle(NamedTuple):
    """An angle [rad], exact: ``coefficient * pi`` if ``of_pi``, else ``coefficient``."""

    coefficient: Fraction
    of_pi: bool = True

    @classmethod
    def parse(cls, value: Any) -> Angle:
        """Read a number (radians), ``"76 deg"``, or a multiple of pi such as ``"-3*pi/4"``.

        Raises
        ------
        ValueError
            The value is none of these, or is not finite.
        """
        if isinstance(value, cls):
            return value
        found = cls._read(value)
        if found is None or abs(found.coefficient) > LARGEST:
            raise ValueError(EXPECTED)
        return found

    @classmethod
    def _read(cls, value: Any) -> Angle | None:
        if isinstance(value, int) and not isinstance(value, bool):
            return cls(Fraction(value), of_pi=False)
        if isinstance(value, float) and math.isfinite(value):
            return cls(Fraction(repr(value)), of_pi=False)
        if isinstance(value, str) and len(value) < 400:
            if match := _DEGREES.fullmatch(value.strip()):
                return cls(Fraction(match[1]) / 180)
            if match := _OF_PI.fullmatch(value.strip()):
                sign, times, over = match.groups(default="")
                if over.strip("0") or not over:
                    return cls(Fraction(f"{sign}{times or 1}") / int(over or 1))
        return None

    def __neg__(self) -> Angle:
        return self._replace(coefficient=-self.coefficient)

    def __float__(self) -> float:
        return float(self.coefficient) * (math.pi if self.of_pi else 1.0)
