"""Why a one-sided search failed: pushed off a goal that obstacles repel, or trapped on the way.

A search that begins at the goal itself rests where attraction and repulsion balance next to it. A
failed search that ends at that same place has met no obstacle on its way: its goal is no
equilibrium. S. S. Ge and Y. J. Cui, New potential functions for mobile robot path planning, IEEE
T-RA 16(5), 2000.
"""

from __future__ import annotations

from dataclasses import replace
from enum import StrEnum

import numpy as np

from ..descent.termination import StopReason
from .bidirectional_compiled import search_compiled
from .search_plan import SearchPlan

_TAIL = 20
_NEVER = 1e-12  # a tolerance that is not met one step away from the goal


class Failure(StrEnum):
    """Where a search that did not arrive came to rest."""

    DISPLACED_GOAL = "displaced-goal"
    MIDWAY_MINIMUM = "midway-minimum"
    NO_REST = "no-rest"


def classify(plan: SearchPlan, same_place: float = 0.2) -> Failure | None:
    """Class of a failed one-sided search; None if it arrived.

    Resting places are means over the last 20 searches, so that chatter does not matter. They are
    the same if no joint differs by more than ``same_place`` [rad]. A search cut off while it still
    made progress has no rest.
    """
    if plan.reached:
        return None
    if plan.reason is StopReason.STEP_LIMIT:
        return Failure.NO_REST
    made = plan.problem
    ending = made.settings.ending.model_copy(update={"tolerance": _NEVER})
    settings = made.settings.model_copy(update={"ending": ending})
    beside = made.goal + 1e-6 * np.sign(plan.path[-1] - made.goal)
    away = search_compiled(replace(made, start=beside, settings=settings))
    places = [record.paths[0][-_TAIL:].mean(axis=0) for record in (plan.record, away)]
    same = np.abs(places[0] - places[1]).max() <= same_place
    return Failure.DISPLACED_GOAL if same else Failure.MIDWAY_MINIMUM
