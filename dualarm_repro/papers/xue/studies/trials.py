"""Many trials in the nominal arrangement: Table 2 as one matrix of all that print leaves open.

Readings of the traditional method, the criterion by which it succeeds, the rule of the joint step,
and how much the starts vary.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ..outcomes import (
    CRITERIA,
    DESCENTS,
    READINGS,
    clear_starts,
    run_variants,
    summary,
    variant_of,
)
from ..reading import CASE, nominal

#: Blocks of trials per rule; the search over 729 neighbours takes ten times as long.
BLOCKS = {"gradient": 4, "neighbour_search": 2}
BLOCK = 25
#: Half widths of the perturbation of the starts [rad]: nominal, and the ends of its range.
HALF_WIDTHS = (0.03, 0.1, 0.2)
_OURS = ("without_virtual", "improved")


def repeated_cell(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Both methods from the same block of starts, in every reading and by either criterion.

    Columns ``<method>_<field>`` are by position, those of ``<method>_goal_angles_<field>`` by the
    goal angles, to which the improved method always has to go.
    """
    case = nominal(update_rule=settings["update_rule"])
    begin, touching = clear_starts(case, settings["half_width"], BLOCK, rng)
    row: dict[str, Any] = {"starts_touching": touching}
    old = tuple(map(variant_of, READINGS))
    for criterion in CRITERIA:
        names = (*old, *_OURS) if criterion == CRITERIA[0] else old
        tag = "" if criterion == CRITERIA[0] else f"{criterion}_"
        for name, runs in run_variants(case, names, begin, criterion).items():
            found = summary(case, name, runs)._asdict()
            row |= {f"{name}_{tag}{field}": value for field, value in found.items()}
    return row


def _cells() -> list[dict[str, Any]]:
    return [
        {"update_rule": rule, "half_width": width, "block": k}
        for rule, count in BLOCKS.items()
        for width in HALF_WIDTHS
        for k in range(count)
    ]


REPEATED = REGISTRY.keeps(
    Study(
        name="xue_trials",
        title="Trials in the nominal arrangement: readings, criteria, rules of the step, starts",
        cells=_cells,
        compute=repeated_cell,
        compared=DESCENTS,
        seed=20200346,
        settings=Chosen("xue", CASE, blocks=BLOCKS, block=BLOCK, half_widths=HALF_WIDTHS),
    )
)
