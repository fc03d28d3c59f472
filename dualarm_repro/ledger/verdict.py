"""The verdict on an item, derived from its rules; it is never typed in."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

from .rules import Evidence, Role, Rule


class Verdict(StrEnum):
    """What the reproduction says about a printed item."""

    REPRODUCED = "reproduced"
    UNDER_ASSUMPTION = "reproduced-under-assumption"
    INCONSISTENT = "inconsistent-in-print"
    NOT_REPRODUCED = "not-reproduced"
    UNDECIDABLE = "undecidable"
    NOT_ATTEMPTED = "not-attempted"
    ADOPTED = "adopted"
    ADAPTED = "adapted"


#: One sentence per verdict, for legends.
MEANING = {
    Verdict.REPRODUCED: "what is obtained agrees with print, and nothing had to be assumed",
    Verdict.UNDER_ASSUMPTION: "agrees with print once the named assumptions are made",
    Verdict.INCONSISTENT: "the document contradicts itself here; the proof is shown",
    Verdict.NOT_REPRODUCED: "what is obtained disagrees with print",
    Verdict.UNDECIDABLE: "a datum that is needed to decide is not printed; this is no pass",
    Verdict.NOT_ATTEMPTED: "no checker is built yet; the reason is given",
    Verdict.ADOPTED: "an input, used exactly as printed",
    Verdict.ADAPTED: "an input, used with the change that is named",
}


def decide(
    rules: Sequence[Rule],
    evidence: Evidence,
    *,
    assumed: bool = False,
    change: str | None = None,
) -> Verdict:
    """Verdict of an item.

    In this order: a supporting rule that fails gives ``not-reproduced``; contradictions that all
    hold give ``inconsistent-in-print``; a needed datum that is not printed gives ``undecidable``;
    inputs are ``adopted``, or ``adapted`` where a change is named; the rest is ``reproduced``,
    under assumption if the item rests on one.

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
    held = {role: [rule.holds(evidence) for rule in rules if rule.role is role] for role in Role}
    if not all(held[Role.SUPPORTS]):
        return Verdict.NOT_REPRODUCED
    if held[Role.CONTRADICTS] and all(held[Role.CONTRADICTS]):
        return Verdict.INCONSISTENT
    if not all(held[Role.DECIDES]):
        return Verdict.UNDECIDABLE
    if held[Role.ADOPTS]:
        if all(held[Role.ADOPTS]):
            return Verdict.ADOPTED
        return Verdict.ADAPTED if change else Verdict.NOT_REPRODUCED
    return Verdict.UNDER_ASSUMPTION if assumed else Verdict.REPRODUCED
