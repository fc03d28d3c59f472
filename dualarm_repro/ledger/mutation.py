"""Mutation test of the checkers: change what was obtained, and the verdict must change."""

from __future__ import annotations

from .evaluation import Evaluation
from .rules import Evidence, Role, Rule
from .verdict import Verdict


def insensitive(evaluation: Evaluation) -> list[str]:
    """Rules that do not respond to what they judge, and verdicts that do not respond to rules.

    Every rule must give the other answer on its flipped evidence. The verdict must change when a
    rule that holds is broken or, where some fail, when all that fail are mended. A contradiction in
    print hides what else is judged, so the other rules are tried where it is broken.
    """
    evidence, rules = evaluation.evidence, list(evaluation.rules)
    deaf = [r.label for r in rules if r.holds(r.flipped(evidence)) == r.holds(evidence)]
    if evaluation.verdict is not Verdict.INCONSISTENT:
        return deaf + _unmoved(evaluation, rules, evidence)
    proof = [rule for rule in rules if rule.role is Role.CONTRADICTS]
    others = [rule for rule in rules if rule.role is not Role.CONTRADICTS]
    deaf += _unmoved(evaluation, proof, evidence)
    return deaf + _unmoved(evaluation, others, proof[0].flipped(evidence))


def _unmoved(evaluation: Evaluation, rules: list[Rule], evidence: Evidence) -> list[str]:
    now = evaluation.verdict_on(evidence)
    if failing := [rule for rule in rules if not rule.holds(evidence)]:
        mended = _flip_all(failing, evidence)
        return [] if evaluation.verdict_on(mended) != now else ["verdict"]
    return [
        f"verdict on {rule.label}"
        for rule in rules
        if evaluation.verdict_on(rule.flipped(evidence)) == now
    ]


def _flip_all(rules: list[Rule], evidence: Evidence) -> Evidence:
    for rule in rules:
        evidence = rule.flipped(evidence)
    return evidence
