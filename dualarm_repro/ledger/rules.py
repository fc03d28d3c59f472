"""Rules that decide a verdict: each looks at what was obtained and at what is printed.

A rule also knows how to be broken (:meth:`Rule.flipped`): the mutation test of the ledger uses it
to prove that every verdict depends on what was obtained.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from enum import StrEnum
from math import isfinite
from typing import Any

import numpy as np

from .printed import EXACT, at, leaves, read_number, replaced, rounds_to


class Role(StrEnum):
    """What a rule that holds says about the document."""

    SUPPORTS = "supports"  # what we obtain agrees with print
    CONTRADICTS = "contradicts"  # the document contradicts itself
    DECIDES = "decides"  # the datum that is needed to decide is printed
    ADOPTS = "adopts"  # the scenario uses the printed input as it is


@dataclass(frozen=True)
class Evidence:
    """The two sides of a rule: ``obtained`` from the computation, ``printed`` from the item."""

    obtained: dict[str, Any]
    printed: Any


@dataclass(frozen=True, kw_only=True)
class Rule(ABC):
    """A statement about one entry of what was obtained."""

    key: str
    label: str
    role: Role = Role.SUPPORTS

    @abstractmethod
    def holds(self, evidence: Evidence) -> bool:
        """Whether the statement is true of the evidence."""

    @abstractmethod
    def expectation(self, evidence: Evidence) -> str:
        """What was expected, for the reader."""

    @abstractmethod
    def flipped(self, evidence: Evidence) -> Evidence:
        """Evidence changed just enough that :meth:`holds` gives the other answer."""

    def found(self, evidence: Evidence) -> Any:
        """The obtained value the rule looks at."""
        return at(evidence.obtained, self.key)

    def _with(self, evidence: Evidence, value: Any) -> Evidence:
        path = tuple(self.key.split("."))
        return Evidence(replaced(evidence.obtained, path, value), evidence.printed)


@dataclass(frozen=True, kw_only=True)
class Rounds(Rule):
    """Every obtained number rounds to the printed digits, or lies within a named tolerance."""

    to: str
    tolerance: float | None = None
    reason: str | None = None

    def __post_init__(self) -> None:
        if (self.tolerance is None) != (self.reason is None):
            raise ValueError("a tolerance wider than the printed digits needs a reason")

    def _pairs(self, evidence: Evidence) -> list[tuple[tuple[Any, ...], str, float]]:
        found = self.found(evidence)
        expected = list(leaves(at(evidence.printed, self.to)))
        if len(expected) != len(list(leaves(found))):
            return []
        return [(path, text, at(found, path)) for path, text in expected]

    def _meets(self, text: str, value: Any) -> bool:
        if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
            return False
        if self.tolerance is None:
            return rounds_to(value, text)
        return abs(value - read_number(text)[0]) <= self.tolerance

    def holds(self, evidence: Evidence) -> bool:
        pairs = self._pairs(evidence)
        return bool(pairs) and all(self._meets(text, value) for _, text, value in pairs)

    def expectation(self, evidence: Evidence) -> str:
        text = f"printed {_plain(at(evidence.printed, self.to))}"
        return (
            text if self.tolerance is None else f"{text} within {self.tolerance:g} ({self.reason})"
        )

    def flipped(self, evidence: Evidence) -> Evidence:
        printed = at(evidence.printed, self.to)
        agreed = printed
        for path, text in leaves(printed):
            agreed = replaced(agreed, path, read_number(text)[0])
        if not self.holds(evidence):
            return self._with(evidence, agreed)
        path, text = next(iter(leaves(printed)))
        value, half_unit = read_number(text)
        allowed = half_unit if self.tolerance is None else self.tolerance
        step = max(3 * allowed, 1e-9 * abs(value))  # large enough to change a float
        return self._with(evidence, replaced(self.found(evidence), path, value + step))


@dataclass(frozen=True, kw_only=True)
class Bounded(Rule):
    """A number lies in [low, high]; either bound may be absent."""

    low: float | None = None
    high: float | None = None

    def __post_init__(self) -> None:
        if self.low is None and self.high is None:
            raise ValueError("a bound is needed")

    def holds(self, evidence: Evidence) -> bool:
        value = self.found(evidence)
        if value is None or not isfinite(value):
            return False
        return (self.low is None or value >= self.low) and (self.high is None or value <= self.high)

    def expectation(self, evidence: Evidence) -> str:
        if self.low is None:
            return f"at most {self.high:g}"
        if self.high is None:
            return f"at least {self.low:g}"
        return f"between {self.low:g} and {self.high:g}"

    def flipped(self, evidence: Evidence) -> Evidence:
        if not self.holds(evidence):
            return self._with(evidence, self.low if self.low is not None else self.high)
        if self.high is not None:
            return self._with(evidence, self.high + max(1e-9, abs(self.high)))
        return self._with(evidence, self.low - max(1e-9, abs(self.low)))


@dataclass(frozen=True, kw_only=True)
class Is(Rule):
    """A boolean, count or text is exactly ``value``, or the printed one at ``to``."""

    value: Any = None
    to: str | None = None

    def __post_init__(self) -> None:
        if (self.value is None) == (self.to is None):
            raise ValueError("give either a value or the printed path")

    def _expected(self, evidence: Evidence) -> Any:
        return self.value if self.to is None else at(evidence.printed, self.to)

    def holds(self, evidence: Evidence) -> bool:
        found, expected = self.found(evidence), self._expected(evidence)
        if isinstance(found, np.generic):
            found = found.item()
        if self.to is None:
            return type(found) is type(expected) and found == expected
        return [(path, str(leaf)) for path, leaf in leaves(found)] == list(leaves(expected))

    def expectation(self, evidence: Evidence) -> str:
        return _plain(self._expected(evidence))

    def flipped(self, evidence: Evidence) -> Evidence:
        expected = self._expected(evidence)
        if not self.holds(evidence):
            return self._with(evidence, expected)
        if isinstance(expected, bool):
            return self._with(evidence, not expected)
        if isinstance(expected, int):
            return self._with(evidence, expected + 1)
        path, leaf = next(iter(leaves(expected)))
        return self._with(evidence, replaced(self.found(evidence), path, f"not {leaf}"))


@dataclass(frozen=True, kw_only=True)
class Adopts(Rule):
    """The scenario feeds the method with the printed input, digit for digit."""

    to: str
    role: Role = Role.ADOPTS

    def _exact(self) -> Rounds:
        return Rounds(key=self.key, label=self.label, to=self.to, tolerance=EXACT, reason="input")

    def holds(self, evidence: Evidence) -> bool:
        return self._exact().holds(evidence)

    def expectation(self, evidence: Evidence) -> str:
        return f"printed {_plain(at(evidence.printed, self.to))}"

    def flipped(self, evidence: Evidence) -> Evidence:
        return self._exact().flipped(evidence)


@dataclass(frozen=True, kw_only=True)
class NeedsPrinted(Rule):
    """The verdict cannot be reached unless the document prints the datum ``key``."""

    role: Role = Role.DECIDES

    def found(self, evidence: Evidence) -> Any:
        printed = evidence.printed
        return printed.get(self.key) if isinstance(printed, dict) else None

    def holds(self, evidence: Evidence) -> bool:
        return self.found(evidence) is not None

    def expectation(self, evidence: Evidence) -> str:
        return f"{self.label} in print"

    def flipped(self, evidence: Evidence) -> Evidence:
        printed = dict(evidence.printed or {})
        if printed.pop(self.key, None) is None:
            printed[self.key] = "supplied"
        return Evidence(evidence.obtained, printed)


def _plain(value: Any) -> str:
    """A nested printed value on one line."""
    if isinstance(value, dict):
        return "; ".join(f"{key}: {_plain(part)}" for key, part in value.items())
    if isinstance(value, list):
        return "(" + ", ".join(_plain(part) for part in value) + ")"
    return str(value)
