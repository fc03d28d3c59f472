"""The ablation: what really frees the arm, over random arrangements and in named ones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ..document import assumptions
from ..outcomes import DESCENTS, TRIALS, VARIANTS, outcomes, starts
from ..reading import CASE, nominal
from .lottery import DRAWN_WITH, random_case

LAYOUTS = 150
#: Trials in the named arrangements.
MANY = 100
#: A yawed window near the shoulders, found by search, in which the virtual point matters.
YAWED = {
    "master_base_x": -1.55,
    "master_base_y": 1.95,
    "master_base_z": 1.0,
    "base_distance": 0.7,
    "window_centre_x": 0.2,
    "window_centre_y": 0.95,
    "window_centre_z": 0.25,
    "window_normal": "chord",
    "window_opening_width": 0.65,
    "window_opening_height": 1.0,
    "window_bar": 0.1,
}
NAMED: dict[str, dict[str, Any]] = {"nominal": {}, "yawed": YAWED}


def ablation_cell(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Every method in one arrangement, from the same starts."""
    name, count = settings["layout"], settings["trials"]
    if name in NAMED:
        case = nominal(**NAMED[name])
    else:
        case = random_case(settings["meeting_distance"], rng)[0]
    begin = starts(case, settings["trial_perturbation"], count, rng)
    return outcomes(case, tuple(VARIANTS), begin)


def _cells() -> list[dict[str, Any]]:
    frozen = assumptions(*DRAWN_WITH)
    named = [{"layout": name, "trials": MANY, **frozen} for name in NAMED]
    drawn = [{"layout": f"random {k}", "trials": TRIALS, **frozen} for k in range(LAYOUTS)]
    return named + drawn


ABLATION = REGISTRY.keeps(
    Study(
        name="xue_ablation",
        title="Joint term, virtual point and its switching, point and five-point repulsion apart",
        cells=_cells,
        compute=ablation_cell,
        compared=DESCENTS,
        seed=20200345,
        settings=Chosen(
            "xue", (*CASE, *DRAWN_WITH), ranges=True, layouts=LAYOUTS, many=MANY, named=NAMED
        ),
    )
)
