"""The verdict on an item, derived from its rules; it is never typed in."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

from .rules import Evidence, Outcome, Role, Rule


class Verdict(StrEnum):
    """What the reproduction says about a printed item."""

    REPRODUCED = "reproduced"
    UNDER_ASSUMPTION = "reproduced-under-assumption"
    INCONSISTENT = "inconsistent-in-print"
    NOT_REPRODUCED = "not-reproduced"
    REGENERATED = "regenerated"
    UNDECIDABLE = "undecidable"
    NOT_ATTEMPTED = "not-attempted"
    ADOPTED = "adopted"
    ADAPTED = "adapted"

    @property
    def meets_print(self) -> bool:
        """Whether what is obtained agrees with what is printed."""
        return self in (
            Verdict.REPRODUCED,
            Verdict.UNDER_ASSUMPTION,
            Verdict.ADOPTED,
            Verdict.ADAPTED,
            Verdict.REGENERATED,
        )


def decide(
    rules: Sequence[Rule],
    evidence: Evidence,
    *,
    assumed: bool = False,
    change: str | None = None,
) -> Verdict:
    """Verdict of an item at one choice of its assumptions.

    In this order: contradictions that all hold give ``inconsistent-in-print``, whatever else fails;
    a supporting rule that fails gives ``not-reproduced``, one that stays open ``undecidable``;
    inputs are ``adopted``, or ``adapted`` where a change is named; what has no original is
    ``regenerated`` (``not-attempted`` once there is an original that nothing compares with); the
    rest is ``reproduced``, under assumption if the item rests on one.

    Parameters
    ----------
    rules
        At least one.
    assumed
        Whether the item rests on assumptions.
    change
        For an input that is not used as printed: what was changed.

    Raises
    ------
    ValueError
        There is no rule, so nothing could fail.
    """
    if not rules:
        raise ValueError("a verdict needs at least one rule")
    found = {role: [rule.outcome(evidence) for rule in rules if rule.role is role] for role in Role}

    def all_hold(role: Role) -> bool:
        return all(outcome is Outcome.HOLDS for outcome in found[role])

    if found[Role.CONTRADICTS] and all_hold(Role.CONTRADICTS):
        return Verdict.INCONSISTENT
    if Outcome.FAILS in found[Role.SUPPORTS]:
        return Verdict.NOT_REPRODUCED
    if Outcome.OPEN in found[Role.SUPPORTS]:
        return Verdict.UNDECIDABLE
    if found[Role.ADOPTS]:
        if all_hold(Role.ADOPTS):
            return Verdict.ADOPTED
        return Verdict.ADAPTED if change else Verdict.NOT_REPRODUCED
    if found[Role.REGENERATES]:
        return Verdict.REGENERATED if all_hold(Role.REGENERATES) else Verdict.NOT_ATTEMPTED
    return Verdict.UNDER_ASSUMPTION if assumed else Verdict.REPRODUCED
