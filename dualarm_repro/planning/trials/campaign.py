"""Plans to many goals: what the planner says, and what is true."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from ...scene import Scene
from ..checks.contact_check import contact_check
from ..search.failure import classify
from ..search.search_plan import SearchPlan


@dataclass(frozen=True)
class Campaign:
    """Searches to n goals.

    Attributes
    ----------
    planner, truth : tuple of bool
        Whether the planner arrived, and whether its path is free for whole links as well (n,).
    searches : tuple of int
        Searches of the plans that arrived.
    failures : dict
        How many of the others failed in which way: the class of a one-sided search, or
        ``halves-apart``.
    clearance : tuple of float
        Smallest distance of every path, as far as it went [m].
    """

    planner: tuple[bool, ...]
    truth: tuple[bool, ...]
    searches: tuple[int, ...]
    failures: dict[str, int]
    clearance: tuple[float, ...]


def campaign(
    plan: Callable[[np.ndarray], SearchPlan], goals: Iterable[np.ndarray], scene: Scene
) -> Campaign:
    """Plan to every goal (nq,) [rad] and check every path in ``scene`` with whole links."""
    plans = [plan(goal) for goal in goals]
    checks = [contact_check(scene, made.path) for made in plans]
    failures = Counter(
        "halves-apart" if made.problem.settings.two_sided else str(classify(made))
        for made in plans
        if not made.reached
    )
    return Campaign(
        planner=tuple(made.reached for made in plans),
        truth=tuple(p.reached and check.free for p, check in zip(plans, checks, strict=True)),
        searches=tuple(made.searches for made in plans if made.reached),
        failures=dict(failures),
        clearance=tuple(check.smallest for check in checks),
    )
