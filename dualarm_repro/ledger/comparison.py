"""Values that are not compared digit by digit: residuals, and what declares a tolerance.

The digits of a residual are those of the rounding errors, and change with the processor. What it
says is that it stays within its bound, so that is what is compared. An ill-conditioned value
declares in the YAML how far it may move, and why.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Any

from .printed import leaves
from .rules import Residual, Rule
from .schema import Item


@dataclass(frozen=True)
class Comparison:
    """How the values at one path below ``obtained`` are compared with their reference.

    ``path`` is dotted. It covers what is below it; ``*`` stands for any one key or index, or for
    any part of one.
    """

    path: str
    reason: str
    bound: float | None = None
    relative: float = 0.0
    absolute: float = 0.0

    def covers(self, path: Sequence[Any]) -> bool:
        """Whether a leaf at ``path``, the keys below ``obtained``, is compared in this way."""
        parts = self.path.split(".")
        return len(parts) <= len(path) and all(
            fnmatchcase(str(key), part) for part, key in zip(parts, path, strict=False)
        )

    def same(self, a: Any, b: Any) -> bool:
        """Whether two numbers are the same answer."""
        if not (is_number(a) and is_number(b)):
            return False
        if self.bound is not None:
            return bool(max(abs(a), abs(b)) <= self.bound)
        return math.isclose(a, b, rel_tol=self.relative, abs_tol=self.absolute)

    @property
    def how(self) -> str:
        """The comparison in words."""
        if self.bound is not None:
            return f"with the bound {self.bound:g}, not by digits ({self.reason})"
        size = f"{self.relative:g} relative" if self.relative else f"{self.absolute:g}"
        return f"within {size} ({self.reason})"


def comparisons(item: Item, rules: Sequence[Rule]) -> list[Comparison]:
    """What an item compares otherwise than by digits, from its rules and its tolerances."""
    residuals = [
        Comparison(rule.key, rule.label, bound=rule.high)
        for rule in rules
        if isinstance(rule, Residual)
    ]
    declared = [
        Comparison(path, entry.reason, None, entry.relative or 0.0, entry.absolute or 0.0)
        for path, entry in item.tolerances.items()
    ]
    return residuals + declared


def idle(declared: Sequence[Comparison], obtained: Any) -> list[str]:
    """Paths that cover no number of what was obtained: misspelt, or left over."""
    numbers = [path for path, leaf in leaves(obtained) if is_number(leaf)]
    return [way.path for way in declared if not any(way.covers(path) for path in numbers)]


def is_number(value: Any) -> bool:
    """Whether a leaf is a number; a boolean is none."""
    return isinstance(value, int | float) and not isinstance(value, bool)
