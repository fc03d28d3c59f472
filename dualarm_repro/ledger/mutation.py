"""Mutation test of the checkers: change what was obtained, and the verdict must change."""

from __future__ import annotations

from .evaluation import Evaluation
from .rules import Evidence, Role, Rule
from .verdict import Verdict, decide


def _verdict(evaluation: Evaluation, evidence: Evidence) -> str:
    return decide(
        evaluation.checker.rules,
        evidence,
        assumed=bool(evaluation.item.assumptions),
        change=evaluation.checker.change,
    )


def insensitive(evaluation: Evaluation) -> list[str]:
    """Rules that do not respond to what they judge, and verdicts that do not respond to rules.

    Every rule must give the other answer on its flipped evidence. The verdict must change when a
    rule that holds is broken or, where some fail, when all that fail are mended. Contradictions
    that all hold decide whatever else does: the other rules are tried with one of them broken.
    """
    evidence, rules = evaluation.evidence, list(evaluation.checker.rules)
    found = [r.label for r in rules if r.holds(r.flipped(evidence)) == r.holds(evidence)]
    if evaluation.verdict is Verdict.INCONSISTENT:
        against = [rule for rule in rules if rule.role is Role.CONTRADICTS]
        found += _unheard(evaluation, against, evidence)
        rules = [rule for rule in rules if rule not in against]
        evidence = against[0].flipped(evidence)
    failing = [rule for rule in rules if not rule.holds(evidence)]
    if not failing:
        return found + _unheard(evaluation, rules, evidence)
    mended = _verdict(evaluation, _flip_all(failing, evidence))
    return found + ([] if mended != _verdict(evaluation, evidence) else ["verdict"])


def _unheard(evaluation: Evaluation, rules: list[Rule], evidence: Evidence) -> list[str]:
    """Which rules can be broken without a change of the verdict."""
    before = _verdict(evaluation, evidence)
    return [
        f"verdict on {rule.label}"
        for rule in rules
        if _verdict(evaluation, rule.flipped(evidence)) == before
    ]


def _flip_all(rules: list[Rule], evidence: Evidence) -> Evidence:
    for rule in rules:
        evidence = rule.flipped(evidence)
    return evidence
