"""Change what was obtained: the rule that looks at it and the verdict must change."""

from __future__ import annotations

from ..evaluation import evaluate
from ..mutation import insensitive
from ..registry import Registry
from .counts import Tally


def obtained(registry: Registry, item_id: str) -> Tally:
    """Break every rule of an item by what it looks at, and the verdict by the rule."""
    evaluation = evaluate(registry, item_id)
    if evaluation.checker is None:
        return Tally()
    deaf = [f"{item_id}: {line}" for line in insensitive(evaluation)]
    return Tally(max(2 * len(evaluation.checker.rules), len(deaf)), tuple(deaf))
