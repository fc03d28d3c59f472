"""Compute an item and judge it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..errors import LedgerError
from .registry import Checker, Registry
from .result import Assumed, Proof, Result
from .rules import Evidence
from .schema import Item
from .verdict import Verdict, decide


@dataclass(frozen=True)
class Evaluation:
    """One item, its result and verdict; ``result`` is None for an item that is not attempted."""

    item_id: str
    item: Item
    checker: Checker | None
    result: Result | None
    verdict: Verdict

    @property
    def evidence(self) -> Evidence:
        """What the rules look at."""
        if self.result is None:
            raise LedgerError(f"{self.item_id}: nothing obtained, {self.item.pending}")
        return Evidence(self.result.obtained, self.item.printed)

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
            }
            for rule in self.checker.rules
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
    """Compute an item, under changed assumptions if given, and derive its verdict.

    Raises
    ------
    UnknownNameError
        No such item.
    LedgerError
        The computation does not read exactly the assumptions that the item declares, so that a page
        would hide one or show one that does not matter.
    """
    item = registry.item(item_id)
    checker = registry.checkers.get(item_id)
    if checker is None:
        return Evaluation(item_id, item, None, None, Verdict.NOT_ATTEMPTED)
    assumed = assumed_values(registry, item_id, changes)
    result = checker.compute(assumed)
    if assumed.read != set(item.assumptions):
        declared, read = sorted(item.assumptions), sorted(assumed.read)
        raise LedgerError(f"{item_id}: declares the assumptions {declared}, but reads {read}")
    verdict = decide(
        checker.rules,
        Evidence(result.obtained, item.printed),
        assumed=bool(item.assumptions),
        change=checker.change,
    )
    return Evaluation(item_id, item, checker, result, verdict)


def prove(registry: Registry, erratum_id: str) -> Proof | None:
    """Run the machine proof of an erratum, if one is registered."""
    proof = registry.proofs.get(erratum_id)
    return None if proof is None else proof()
