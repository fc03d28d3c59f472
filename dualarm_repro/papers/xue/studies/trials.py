"""Many trials in the nominal arrangement, per rule of the joint step."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ..document import assumptions
from ..outcomes import DESCENTS, outcomes, starts
from ..reading import CASE, nominal

#: Blocks of trials per rule; the search over 729 neighbours takes ten times as long.
BLOCKS = {"gradient": 12, "neighbour_search": 8}
BLOCK = 25


def repeated_cell(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Both methods from the same block of starts."""
    case = nominal(update_rule=settings["update_rule"])
    begin = starts(case, settings["trial_perturbation"], BLOCK, rng)
    return outcomes(case, ("traditional", "without_virtual", "improved"), begin)


def _cells() -> list[dict[str, Any]]:
    return [
        {"update_rule": rule, "block": k, **assumptions("trial_perturbation")}
        for rule, count in BLOCKS.items()
        for k in range(count)
    ]


REPEATED = REGISTRY.keeps(
    Study(
        name="xue_trials",
        title="Trials of both methods in the nominal arrangement, per rule of the joint step",
        cells=_cells,
        compute=repeated_cell,
        compared=DESCENTS,
        seed=20200346,
        settings=Chosen("xue", (*CASE, "trial_perturbation"), blocks=BLOCKS, block=BLOCK),
    )
)
