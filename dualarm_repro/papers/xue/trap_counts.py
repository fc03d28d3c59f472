"""Trapped runs of both methods as printed: by the rows of Table 2, and by the text before it."""

from __future__ import annotations

from ...ledger import REGISTRY

METHODS_OF_TABLE_2 = ("traditional", "improved")


def table_counts() -> dict[str, int]:
    """The trap column of Table 2 by row."""
    printed = REGISTRY.printed("xue.tab02")
    return {name: int(printed[name]["trapped"]) for name in METHODS_OF_TABLE_2}


def text_counts() -> dict[str, int]:
    """The same by the text: how often the traditional method is trapped, the improved one fails."""
    success = REGISTRY.printed("xue.claim_success_10")
    trials = int(success["trials"])
    arrived = trials if success["successes"] == "all" else int(success["successes"])
    trapped = int(REGISTRY.printed("xue.claim_trapped_8")["trapped"])
    return {"traditional": trapped, "improved": trials - arrived}
