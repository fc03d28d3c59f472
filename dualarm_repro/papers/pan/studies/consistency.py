"""Which readings of the text could give the printed point: optima over sampled assumptions."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np
from scipy.stats import qmc

from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen, plausible
from ....welding import Objective, Status, grid_optimum
from ....welding.grid_search import grid_points
from ....welding.landscape import nearer_image
from ....welding.placement import blocks
from ..document import SEED, printed_optimum
from ..reading import SPACING, Job

SETS = 256
SEAM_POINTS = 18
_TOLERANCE = 0.01  # [m]
READINGS = ("inverted", "literal")
#: Assumptions that are drawn; those left out concern the search or the fineness of the seam.
VARIED = ("arm", "shoulder_height", "radius_main", "radius_branch", "workpiece_length",
          "branch_length", "gripper_length", "grasp", "flat_posture", "torch_length",
          "torch_crank", "torch_axis", "base_orientation", "link_radius_scale",
          "floor", "carrier_reference")  # fmt: skip
#: Readings of (16), by the names used in tables and figures.
OBJECTIVES = {
    "inverse volume": Objective(),
    "inverse volume, sum": Objective(carriers="sum"),
    "inverse volume, coupled pair": Objective(carriers="coupled_pair"),
    "inverse volume, twist": Objective(space="full"),
    "inverse volume, twist, sum": Objective(space="full", carriers="sum"),
    "inverse volume, twist, coupled pair": Objective(space="full", carriers="coupled_pair"),
    "equal weights": Objective(weights="equal"),
    "harmonic mean": Objective(weights="harmonic"),
    "carriers only, (15)": Objective(weights="tight_only"),
    "welder only": Objective(weights="loose_only"),
    "inverse volume, minimum": Objective(aggregation="minimum"),
    "equal weights, minimum": Objective(weights="equal", aggregation="minimum"),
    "carriers only, minimum": Objective(weights="tight_only", aggregation="minimum"),
    "inverse volume, mm": Objective(unit="mm"),
    "equal weights, mm": Objective(weights="equal", unit="mm"),
    "inverse volume, geometric mean": Objective(pair="geometric_mean"),
    "equal weights, geometric mean": Objective(weights="equal", pair="geometric_mean"),
}


def cells() -> list[dict[str, Any]]:
    """Every sampled set of assumptions in both readings of the base transform."""
    engine = qmc.Sobol(len(VARIED), scramble=True, rng=np.random.default_rng(SEED))
    sets = [
        {key: plausible(f"pan.{key}", share) for key, share in zip(VARIED, row, strict=True)}
        for row in engine.random(SETS)
    ]
    return [
        {"set": k, "base_transform": reading, **values}
        for (k, values), reading in product(enumerate(sets), READINGS)
    ]


def compute(settings: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Feasible share, what the printed point fails by, and the optimum of every objective.

    Each is the best cell of a grid, refined to one centimetre; of two mirror images as good as each
    other the one nearer to the printed point.
    """
    values = {**REGISTRY.nominal("pan"), **settings, "seam_points": SEAM_POINTS}
    placement, box = Job.of(values).placement(), np.array(values["search_box"])
    jobs = [placement.jobs(block) for block in blocks(grid_points(box, SPACING))]
    feasible = np.concatenate([some.feasible for some in jobs])
    at_print = placement.jobs([printed_optimum()])
    row: dict[str, Any] = {
        "feasible_share": float(feasible.mean()),
        "printed_point": Status(int(at_print.status[0])).name.lower(),
    }
    for name, objective in OBJECTIVES.items():
        placement.objective = objective
        found = np.full(4, np.nan)
        if feasible.any():
            scores = np.concatenate([placement.score(some) for some in jobs])
            best = grid_optimum(placement, box, SPACING, 1, _TOLERANCE, scores)
            best = nearer_image(best, placement, printed_optimum())
            found = np.append(best.position, best.fitness)
        row |= {f"{name} {part}": float(v) for part, v in zip("xyzf", found, strict=True)}
    return row


CONSISTENCY = Study(
    name="pan_consistency",
    title="Optimum of every reading of the measure over sampled assumptions, both base transforms",
    cells=cells,
    compute=compute,
    seed=SEED,
    settings=Chosen(
        "pan", (*VARIED, "search_box", "singularity_threshold", "torch_exemption"), ranges=True
    ),
)
REGISTRY.keeps(CONSISTENCY)
