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
    rule that holds is broken or, where some fail, when all that fail are mended. Where the document
    contradicts itself, only what proves it can change the verdict.
    """
    evidence = evaluation.evidence
    rules = evaluation.checker.rules
    deaf = [r.label for r in rules if r.holds(r.flipped(evidence)) == r.holds(evidence)]
    if evaluation.verdict is Verdict.INCONSISTENT:
        rules = tuple(rule for rule in rules if rule.role is Role.CONTRADICTS)
    failing = [rule for rule in rules if not rule.holds(evidence)]
    if failing:
        mended = _flip_all(failing, evidence)
        return deaf + ([] if _verdict(evaluation, mended) != evaluation.verdict else ["verdict"])
    return deaf + [
        f"verdict on {rule.label}"
        for rule in rules
        if _verdict(evaluation, rule.flipped(evidence)) == evaluation.verdict
    ]


def _flip_all(rules: list[Rule], evidence: Evidence) -> Evidence:
    for rule in rules:
        evidence = rule.flipped(evidence)
    return evidence
