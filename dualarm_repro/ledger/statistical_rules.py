"""Rules about a population of which a sample was drawn: they hold, fail, or stay open."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from .rules import Evidence, Outcome, Rule, bound
from .shares import Share


@dataclass(frozen=True, kw_only=True)
class Generally(Rule):
    """A statement about a whole population, of which a sample was drawn: three answers.

    The obtained value is a mapping with ``count`` and ``of``. With its 95 % interval after Wilson,
    the statement holds where the whole interval lies at or above ``at_least``, fails where it lies
    below ``at_least - margin``, and is open otherwise (for ``at_most`` the other way round). More
    draws can only settle what is open.
    """

    at_least: float | str | None = None
    at_most: float | str | None = None
    margin: float | str = 0.0

    def __post_init__(self) -> None:
        if (self.at_least is None) == (self.at_most is None):
            raise ValueError("give either at_least or at_most")

    def _limits(self, evidence: Evidence) -> tuple[float, float]:
        limit = self.at_most if self.at_least is None else self.at_least
        return (
            bound(limit, inf, evidence.thresholds),
            bound(self.margin, 0.0, evidence.thresholds),
        )

    def share(self, evidence: Evidence) -> Share:
        """The observed share with its interval."""
        found = self.found(evidence)
        return Share.of(found["count"], found["of"])

    def outcome(self, evidence: Evidence) -> Outcome:
        (limit, margin), share = self._limits(evidence), self.share(evidence)
        if self.at_least is not None:
            above, below = share.low >= limit, share.high < limit - margin
        else:
            above, below = share.high <= limit, share.low > limit + margin
        return Outcome.HOLDS if above else Outcome.FAILS if below else Outcome.OPEN

    def holds(self, evidence: Evidence) -> bool:
        return self.outcome(evidence) is Outcome.HOLDS

    def miss(self, evidence: Evidence) -> float:
        (limit, _), share = self._limits(evidence), self.share(evidence)
        return 0.0 if self.holds(evidence) else abs(limit - share.value)

    def expectation(self, evidence: Evidence) -> str:
        limit, margin = self._limits(evidence)
        side, other = ("at least", "below") if self.at_least is not None else ("at most", "above")
        edge = limit - margin if self.at_least is not None else limit + margin
        return f"{side} {limit:g} of the population; fails {other} {edge:g}, else open"

    def flipped(self, evidence: Evidence) -> Evidence:
        many = 10_000
        good = self.at_least is not None
        count = 0 if self.holds(evidence) is good else many
        return self._with(evidence, {**self.found(evidence), "count": count, "of": many})


@dataclass(frozen=True, kw_only=True)
class Exceeds(Rule):
    """An estimate lies above ``threshold``, with its interval: three answers.

    The obtained value is a mapping with ``value``, ``low`` and ``high``. It holds where the whole
    interval lies above the threshold, fails where it lies below, and is open otherwise.
    """

    threshold: float | str = 0.0

    def _edge(self, evidence: Evidence) -> float:
        return bound(self.threshold, 0.0, evidence.thresholds)

    def outcome(self, evidence: Evidence) -> Outcome:
        found, edge = self.found(evidence), self._edge(evidence)
        if found["low"] > edge:
            return Outcome.HOLDS
        return Outcome.FAILS if found["high"] < edge else Outcome.OPEN

    def holds(self, evidence: Evidence) -> bool:
        return self.outcome(evidence) is Outcome.HOLDS

    def miss(self, evidence: Evidence) -> float:
        edge, found = self._edge(evidence), self.found(evidence)
        return 0.0 if self.holds(evidence) else max(edge - found["low"], 0.0)

    def expectation(self, evidence: Evidence) -> str:
        return f"interval above {self._edge(evidence):g}; fails below, else open"

    def flipped(self, evidence: Evidence) -> Evidence:
        sign = -1.0 if self.holds(evidence) else 1.0
        away = [self._edge(evidence) + sign * step for step in (1.0, 0.5, 1.5)]
        names = ("value", "low", "high") if sign > 0 else ("value", "high", "low")
        return self._with(evidence, dict(zip(names, away, strict=True)))
