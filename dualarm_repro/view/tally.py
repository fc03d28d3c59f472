"""How many items have which verdict, in the groups that a sentence names."""

from __future__ import annotations

from collections import Counter
from typing import Any

from ..ledger import Registry, Verdict, record

#: Verdicts by what a sentence calls them.
GROUPS = {
    "met": (Verdict.REPRODUCED,),
    "possible": (Verdict.UNDER_ASSUMPTION,),
    "not_found": (Verdict.NOT_REPRODUCED,),
    "open": (Verdict.UNDECIDABLE,),
    "inconsistent": (Verdict.INCONSISTENT,),
    "anew": (Verdict.REGENERATED,),
    "inputs": (Verdict.ADOPTED, Verdict.ADAPTED),
    "not_attempted": (Verdict.NOT_ATTEMPTED,),
}


def tally(registry: Registry, paper: str | None = None) -> dict[str, Any]:
    """Counts by group, of one document or of all: ``items`` in all, and ``by_verdict``.

    Parameters
    ----------
    paper
        Id of a document; default all of them.
    """
    chosen = [i for i in registry.items if paper is None or i.partition(".")[0] == paper]
    counted = Counter(Verdict(record(registry, item_id)["verdict"]) for item_id in chosen)
    groups = {name: sum(counted[v] for v in verdicts) for name, verdicts in GROUPS.items()}
    return {**groups, "items": len(chosen), "by_verdict": counted}
