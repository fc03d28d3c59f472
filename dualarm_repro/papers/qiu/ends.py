"""How a search from both ends of `qiu` came out, beside what is printed of its two halves."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...ledger import Is, Rounds
from ...ledger.rules import Rule
from ...planning.search.search_plan import SearchPlan

#: How near a printed point counts as met.
_NEAR = {
    "tolerance": 0.016,
    "reason": "half the way of the flange of the straight arm in one printed step",
}
_HALVES = ("forward", "backward")


def count_rules(joined: str) -> list[Rule]:
    """Rules for the printed numbers of searches; ``joined`` says that the halves meet."""
    counts = [Rounds(half, f"searches of the {half} half", to=half) for half in _HALVES]
    return [*counts, Is("joined", joined, value=True)]


def meeting_rules(joined: str) -> list[Rule]:
    """Rules for the printed ends of the halves."""
    ends = [Rounds(half, f"end of the {half} half [m]", to=half, **_NEAR) for half in _HALVES]
    return [*ends, Is("joined", joined, value=True)]


def outcome(plan: SearchPlan, printed: np.ndarray) -> dict[str, Any]:
    """How a search came out, and where its halves end beside print (2, 3) [m]."""
    pairs = zip(plan.ends, printed, strict=True)
    return {
        "reason": str(plan.reason),
        "searches": plan.searches,
        "ends": [end.tolist() for end in plan.ends],
        "gap_tip": float(np.linalg.norm(plan.ends[0] - plan.ends[1])),
        "distance_to_print": [float(np.linalg.norm(end - point)) for end, point in pairs],
    }


def counted(face: dict[str, Any], other: dict[str, Any]) -> dict[str, Any]:
    """What the rules for the numbers look at, from the outcomes of both readings."""
    return {
        **dict.fromkeys(_HALVES, face["searches"]),
        "joined": face["reason"] == "reached",
        "face_value": face,
        "reconstruction": other,
    }


def met(face: dict[str, Any], other: dict[str, Any], printed: np.ndarray) -> dict[str, Any]:
    """What the rules for the ends look at, from the outcomes of both readings."""
    return {
        **dict(zip(_HALVES, face["ends"], strict=True)),
        "joined": face["reason"] == "reached",
        "gap_tip": face["gap_tip"],
        "printed_gap_tip": float(np.linalg.norm(np.subtract(*printed))),
        "distance_to_print": face["distance_to_print"],
        "reconstruction": other,
    }
