"""Compute an item and judge it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..errors import LedgerError
from ..tracking import recording
from .registry import Checker, Registry
from .result import Assumed, Proof, Result
from .rules import Evidence, Rule
from .schema import Item
from .verdict import Verdict, decide


@dataclass(frozen=True)
class Evaluation:
    """One item, its result, and the verdict on it; without checker and result if it is not
    attempted.

    ``inputs`` are those that the computation itself read, see ``tracking``.
    """

    item_id: str
    item: Item
    checker: Checker | None
    result: Result | None
    inputs: frozenset[str] = frozenset()
    verdict: Verdict = field(init=False)

    def __post_init__(self) -> None:
        found = self.verdict_on(self.evidence) if self.checker else Verdict.NOT_ATTEMPTED
        object.__setattr__(self, "verdict", found)

    @property
    def evidence(self) -> Evidence:
        """What the rules look at."""
        if self.result is None:
            raise LedgerError(f"{self.item_id}: nothing obtained, {self.item.pending}")
        thresholds = {name: entry.value for name, entry in self.item.thresholds.items()}
        return Evidence(self.result.obtained, self.item.printed, thresholds)

    @property
    def rules(self) -> tuple[Rule, ...]:
        """What judges the item; none for an item that is not attempted."""
        return self.checker.rules if self.checker else ()

    def verdict_on(self, evidence: Evidence) -> Verdict:
        """The verdict if this had been found."""
        change = self.checker.change if self.checker else None
        return decide(self.rules, evidence, assumed=bool(self.item.assumptions), change=change)

    def checks(self) -> list[dict[str, Any]]:
        """Each rule with what it expected, what it found and whether it holds."""
        if self.checker is None:
            return []
        evidence = self.evidence
        return [
            {
                "label": rule.label,
                "role": str(rule.role),
                "expected": rule.expectation(evidence),
                "obtained": rule.found(evidence),
                "holds": rule.holds(evidence),
                "outcome": str(rule.outcome(evidence)),
            }
            for rule in self.rules
        ]


def assumed_values(
    registry: Registry, item_id: str, changes: Mapping[str, Any] | None = None
) -> Assumed:
    """Assumption values of the item's document, some of them changed."""
    assumptions = registry.paper_of(item_id).assumptions
    return Assumed({key: entry.value for key, entry in assumptions.items()} | dict(changes or {}))


def evaluate(
    registry: Registry, item_id: str, changes: Mapping[str, Any] | None = None
) -> Evaluation:
    """Compute an item at one choice of its assumptions, and judge it there.

    The inputs that are read are noted, see ``tracking``.

    Raises
    ------
    UnknownNameError
        No such item.
    LedgerError
        The computation reads an assumption that the item does not declare, so that a page would
        hide it.
    """
    item = registry.look(item_id, "printed", "thresholds", "assumptions", "context")
    checker = registry.checker(item_id)
    if checker is None:
        return Evaluation(item_id, item, None, None)
    assumed = assumed_values(registry, item_id, changes)
    with recording() as inputs:
        result = checker.compute(assumed)
    if undeclared := sorted(assumed.read - {*item.assumptions, *item.context}):
        raise LedgerError(f"{item_id}: reads the assumptions {undeclared}, but declares them not")
    for name in sorted(assumed.read):
        registry.assumption(f"{item_id.partition('.')[0]}.{name}")
    return Evaluation(item_id, item, checker, result, frozenset(inputs))


def prove(registry: Registry, erratum_id: str) -> Proof | None:
    """Run the machine proof of an erratum, if one is registered."""
    proof = registry.proof(erratum_id)
    return None if proof is None else proof()
