"""Verdict badges: text first, colour second."""

from __future__ import annotations

from html import escape

from ..ledger import MEANING, Verdict

#: Sign shown before the word, so that the badge can be told without colour.
SIGN = {
    Verdict.REPRODUCED: "✓",
    Verdict.UNDER_ASSUMPTION: "✓*",
    Verdict.INCONSISTENT: "≠",
    Verdict.NOT_REPRODUCED: "✗",
    Verdict.UNDECIDABLE: "?",
    Verdict.NOT_ATTEMPTED: "…",
    Verdict.ADOPTED: "=",
    Verdict.ADAPTED: "≈",
}


def badge(verdict: str) -> str:
    """HTML badge of a verdict with its meaning as a tooltip."""
    known = Verdict(verdict)
    return (
        f'<span class="verdict verdict-{known}" title="{escape(MEANING[known])}">'
        f"{SIGN[known]} {known}</span>"
    )
