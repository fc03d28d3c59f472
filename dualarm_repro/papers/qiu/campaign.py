"""Many plans of the master to many goals: what the planner says, and what is true."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import binomtest

from ...planning.bidirectional_compiled import plan_bidirectional_compiled
from ...planning.contact_check import contact_check
from ...planning.failure import classify
from .goals import GoalSet
from .readings import Variant, master_arm, settings
from .scenario import START, repelling, truth_scene


@dataclass(frozen=True)
class Campaign:
    """One variant on n goals: planner and truth (n,) of bool, searches of the plans that arrived,
    classes of failure, smallest distances (n,) [m]."""

    planner: tuple[bool, ...]
    truth: tuple[bool, ...]
    searches: tuple[int, ...]
    failures: dict[str, int]
    clearance: tuple[float, ...]


def campaign(
    values: Mapping[str, Any], variant: Variant, goals: GoalSet, radius_scale: float = 1.0
) -> Campaign:
    """Plan to every goal of a set and check every path with whole links."""
    arm = master_arm(values, radius_scale)
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


def rate(outcomes: Sequence[bool]) -> dict[str, float]:
    """Share of successes with its 95 % interval (Wilson)."""
    kept, count = int(np.sum(outcomes)), len(outcomes)
    interval = binomtest(kept, count).proportion_ci(method="wilson")
    return {
        "successes": kept,
        "of": count,
        "rate": kept / count,
        "low": float(interval.low),
        "high": float(interval.high),
    }
