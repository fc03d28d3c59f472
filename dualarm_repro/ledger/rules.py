"""Rules that decide a verdict: each looks at what was obtained and at what is printed.

A rule also knows how to be broken (:meth:`Rule.flipped`): the mutation test of the ledger uses it
to prove that every verdict depends on what was obtained.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from math import inf, isfinite
from typing import Any

import numpy as np

from ..errors import LedgerError
from .printed import EXACT, at, leaves, read_number, replaced, rounds_to


class Role(StrEnum):
    """What a rule that holds says about the document."""

    SUPPORTS = "supports"  # what we obtain agrees with print
    CONTRADICTS = "contradicts"  # the document contradicts itself
    REGENERATES = "regenerates"  # the source at hand holds no original to compare with
    ADOPTS = "adopts"  # the scenario uses the printed input as it is


class Outcome(StrEnum):
    """What a statement comes to; only a statistical one can stay open."""

    HOLDS = "holds"
    FAILS = "fails"
    OPEN = "open"


@dataclass(frozen=True)
class Evidence:
    """What a rule looks at: ``obtained`` by the computation, ``printed`` and ``thresholds`` of the
    item."""

    obtained: dict[str, Any]
    printed: Any
    thresholds: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Rule(ABC):
    """A statement about one entry of what was obtained."""

    key: str
    label: str
    role: Role = field(default=Role.SUPPORTS, kw_only=True)

    @abstractmethod
    def holds(self, evidence: Evidence) -> bool:
        """Whether the statement is true of the evidence."""

    def outcome(self, evidence: Evidence) -> Outcome:
        """The same with a third answer, for rules about a sample of a population."""
        return Outcome.HOLDS if self.holds(evidence) else Outcome.FAILS

    def miss(self, evidence: Evidence) -> float:
        """How far the statement is from holding, 0 where it holds; guides a directed search."""
        return 0.0 if self.holds(evidence) else 1.0

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
        return replace(evidence, obtained=replaced(evidence.obtained, path, value))


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

    def miss(self, evidence: Evidence) -> float:
        if self.holds(evidence):
            return 0.0
        gaps = []
        for _, text, value in self._pairs(evidence):
            printed, half_unit = read_number(text)
            number = isinstance(value, int | float) and not isinstance(value, bool)
            gap = abs(value - printed) if number and isfinite(value) else inf
            gaps.append(gap / max(abs(printed), half_unit))
        return max(gaps, default=inf)

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
    """A number lies in [low, high]; either bound may be absent.

    A bound is a number, or the name of a threshold that the item declares with its reason.
    """

    low: float | str | None = None
    high: float | str | None = None

    def __post_init__(self) -> None:
        if self.low is None and self.high is None:
            raise ValueError("a bound is needed")

    def bounds(self, evidence: Evidence) -> tuple[float, float]:
        """Both bounds as numbers, infinite where absent.

        Raises
        ------
        LedgerError
            The item declares no threshold of that name.
        """
        return (
            bound(self.low, -inf, evidence.thresholds),
            bound(self.high, inf, evidence.thresholds),
        )

    def holds(self, evidence: Evidence) -> bool:
        value, (low, high) = self.found(evidence), self.bounds(evidence)
        return value is not None and isfinite(value) and low <= value <= high

    def miss(self, evidence: Evidence) -> float:
        value, (low, high) = self.found(evidence), self.bounds(evidence)
        if value is None or not isfinite(value):
            return inf
        gap = max(low - value, value - high, 0.0)
        return gap / max(abs(low if value < low else high), 1e-9) if gap else 0.0

    def expectation(self, evidence: Evidence) -> str:
        low, high = self.bounds(evidence)
        if low == -inf:
            return f"at most {high:g}"
        if high == inf:
            return f"at least {low:g}"
        return f"between {low:g} and {high:g}"

    def flipped(self, evidence: Evidence) -> Evidence:
        low, high = self.bounds(evidence)
        if not self.holds(evidence):
            return self._with(evidence, low if low > -inf else high)
        if high < inf:
            return self._with(evidence, high + max(1e-9, abs(high)))
        return self._with(evidence, low - max(1e-9, abs(low)))


@dataclass(frozen=True, kw_only=True)
class Residual(Bounded):
    """A number that is zero up to round-off or truncation: at most ``high`` in size.

    Its digits are those of the errors, so `verify` compares it with the bound instead.
    """

    high: float = 0.0

    def __post_init__(self) -> None:
        if self.low is not None or not 0 < self.high < float("inf"):
            raise ValueError("a residual needs a positive bound `high` and no other")

    def holds(self, evidence: Evidence) -> bool:
        value = self.found(evidence)
        return value is not None and bool(abs(value) <= self.high)


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
    role: Role = field(default=Role.ADOPTS, kw_only=True)

    def _exact(self) -> Rounds:
        return Rounds(key=self.key, label=self.label, to=self.to, tolerance=EXACT, reason="input")

    def holds(self, evidence: Evidence) -> bool:
        return self._exact().holds(evidence)

    def expectation(self, evidence: Evidence) -> str:
        return f"printed {_plain(at(evidence.printed, self.to))}"

    def flipped(self, evidence: Evidence) -> Evidence:
        return self._exact().flipped(evidence)


@dataclass(frozen=True, kw_only=True)
class NoOriginal(Rule):
    """The source at hand holds no original ``key`` (a drawing, a formula) to compare with.

    What is obtained then is regenerated: it must have the properties that the other rules check.
    """

    role: Role = field(default=Role.REGENERATES, kw_only=True)

    def found(self, evidence: Evidence) -> Any:
        printed = evidence.printed
        return printed.get(self.key) if isinstance(printed, dict) else None

    def holds(self, evidence: Evidence) -> bool:
        return self.found(evidence) is None

    def expectation(self, evidence: Evidence) -> str:
        return f"{self.label}: no original in the source at hand"

    def flipped(self, evidence: Evidence) -> Evidence:
        printed = dict(evidence.printed) if isinstance(evidence.printed, dict) else {}
        if printed.pop(self.key, None) is None:
            printed[self.key] = "supplied"
        return replace(evidence, printed=printed)


def bound(limit: float | str | None, absent: float, thresholds: Mapping[str, float]) -> float:
    """A limit as a number: itself, the threshold that it names, or ``absent`` where there is none.

    Raises
    ------
    LedgerError
        The item declares no threshold of that name.
    """
    if isinstance(limit, str):
        if limit not in thresholds:
            raise LedgerError(f"no threshold named {limit!r} is declared for the item")
        return thresholds[limit]
    return absent if limit is None else limit


def _plain(value: Any) -> str:
    """A nested printed value on one line."""
    if isinstance(value, dict):
        return "; ".join(f"{key}: {_plain(part)}" for key, part in value.items())
    if isinstance(value, list):
        return "(" + ", ".join(_plain(part) for part in value) + ")"
    return str(value)
