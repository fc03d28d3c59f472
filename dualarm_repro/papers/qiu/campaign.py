"""Many plans of the master to many goals: what the planner says, and what is true."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...ledger.shares import Share
from ...planning.checks.contact_check import contact_check
from ...planning.search.bidirectional_compiled import plan_bidirectional_compiled
from ...planning.search.failure import classify
from .goals import GoalSet
from .readings import Variant, master_arm, settings
from .scenario import START, repelling, truth_scene

#: What the readings of success look at.
JUDGED_BY = {"planner_and_truth": "truth", "planner": "planner"}


@dataclass(frozen=True)
class Campaign:
    """One variant on n goals: planner and truth (n,) of bool, searches of the plans that arrived,
    classes of failure, smallest distances (n,) [m]."""

    planner: tuple[bool, ...]
    truth: tuple[bool, ...]
    searches: tuple[int, ...]
    failures: dict[str, int]
    clearance: tuple[float, ...]


def campaign(values: Mapping[str, Any], variant: Variant, goals: GoalSet) -> Campaign:
    """Plan to every goal of a set and check every path with whole links."""
    arm = master_arm(values)
    scene, chosen, obstacles = truth_scene([arm]), settings(values, variant), repelling()
    planner, truth, searches, clearance = [], [], [], []
    failures: Counter[str] = Counter()
    for goal in goals.q:
        plan = plan_bidirectional_compiled(arm, START, goal, obstacles, chosen)
        check = contact_check(scene, plan.path)
        planner.append(plan.reached)
        truth.append(plan.reached and check.free)
        clearance.append(check.smallest)
        if plan.reached:
            searches.append(plan.searches)
        elif not variant.two_sided:
            failures[str(classify(plan))] += 1
        else:
            failures["halves-apart"] += 1
    return Campaign(tuple(planner), tuple(truth), tuple(searches), dict(failures), tuple(clearance))


def rate_of(successes: Any, trials: Any) -> dict[str, float]:
    """:func:`rate` of counted successes (n,) in counted trials (n,)."""
    kept, count = int(np.sum(successes)), int(np.sum(trials))
    return rate([True] * kept + [False] * (count - kept))


def rate(outcomes: Sequence[bool]) -> dict[str, float]:
    """Share of successes with its 95 % interval (Wilson)."""
    kept, count = int(np.sum(outcomes)), len(outcomes)
    share = Share.of(kept, count)
    return {
        "successes": kept,
        "of": count,
        "rate": share.value,
        "low": share.low,
        "high": share.high,
    }
