"""Verdict badges: text first, colour second, and the share of choices that meet print."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from markupsafe import Markup

from ..ledger.meaning import MEANING
from ..ledger.verdict import Verdict

#: Sign shown before the word, so that the badge can be told without colour.
SIGN = {
    Verdict.REPRODUCED: "✓",
    Verdict.UNDER_ASSUMPTION: "✓*",
    Verdict.INCONSISTENT: "≠",
    Verdict.NOT_REPRODUCED: "✗",
    Verdict.REGENERATED: "↻",
    Verdict.UNDECIDABLE: "?",
    Verdict.NOT_ATTEMPTED: "…",
    Verdict.ADOPTED: "=",
    Verdict.ADAPTED: "≈",
}


def badge(verdict: str, robustness: Mapping[str, Any] | None = None) -> Markup:
    """HTML badge of a verdict, its meaning as a tooltip.

    Parameters
    ----------
    robustness
        Of the record; a verdict that is only possible shows its share of the plausible choices.
    """
    known = Verdict(verdict)
    share, note = "", ""
    if robustness and known is Verdict.UNDER_ASSUMPTION:
        share = f", {percent(robustness['meets_print']['share'])}"
        low, high = robustness["meets_print"]["interval"]
        note = f". Print is met in {interval(low, high)} of the plausible choices."
    span = Markup('<span class="verdict verdict-{0}" title="{1}">{2} {0}{3}</span>')
    return span.format(known, MEANING[known] + note, SIGN[known], share)


def badge_of(made: Mapping[str, Any]) -> Markup:
    """Badge of a record; with the share of its own draws only where these decide the verdict."""
    return badge(made["verdict"], None if made["decided_by"] else made["robustness"])


def percent(share: float, digits: int = 0) -> str:
    """A share as a percentage that says 0 or 100 only where it is exactly that.

    Parameters
    ----------
    digits
        Decimals of the percentage.
    """
    least = 0.01 / 10**digits
    if 0.0 < share < least:
        return f"< {100 * least:.{digits}f} %"
    if 1.0 - least < share < 1.0:
        return f"> {100 * (1.0 - least):.{digits}f} %"
    return f"{100 * share:.{digits}f} %"


def interval(low: float, high: float) -> str:
    """A 95 % interval of a share."""
    return f"{100 * low:.0f} to {100 * high:.0f} %"
