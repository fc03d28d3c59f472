"""What `pan` says of badly chosen starts: no complete motion, collisions, singularities."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from .....ledger import REGISTRY, Assumed, Bounded, Result
from .....ledger.captions import captions
from .....view.landscape import statuses_figure
from .....welding import Placement, Status, extreme_position
from .....welding.landscape import reaches_point
from ...reading import SPACING, STARTS, Measure, Problem, nothing_feasible, surveyed

checks = partial(REGISTRY.checks, page="pan/optimum")
caption = captions(__file__)
_DRAWS = 16  # of the assumptions, where each needs a search of its own
#: What the constraints exclude is the same for every reading of (16).
_ANY_MEASURE = Measure("equal", "translational", "mean", "product", "mmr", "mean", "m")


@checks(
    "pan.claim_bad_start",
    rules=[
        Bounded(
            "lost",
            "positions at which all robots reach the first seam point and no full paths exist",
            low=1,
        )
    ],
)
def bad_start(assumed: Assumed) -> Result:
    """Of the positions whose first seam point can be welded, those without full paths."""
    task = Problem.of(assumed, _ANY_MEASURE)
    grid = surveyed(task)
    begun = reaches_point(task.job.cell(), grid.points, 0)
    no_path = np.isin(grid.status, (Status.OUT_OF_REACH, Status.JOINT_LIMITS))
    found = Status(int(np.bincount(grid.status[begun & no_path]).argmax())) if begun.any() else None
    return Result(
        obtained={
            "lost": int((begun & no_path).sum()),
            "begun": int(begun.sum()),
            "share": float(no_path[begun].mean()) if begun.any() else None,
            "mostly": found.name.lower().replace("_", " ") if found is not None else None,
        },
        caption=caption("claim_bad_start", positions=len(grid.points)),
        alt="Two maps of the region that show which constraint excludes a position.",
        figure=lambda: statuses_figure(task.job.placement(), task.box),
    )


@checks(
    "pan.claim_meets_collision",
    rules=[
        Bounded("colliding", "positions with full paths on which bodies touch", low=1),
    ],
)
def meets_collision(assumed: Assumed) -> Result:
    """Positions of the grid at which all robots have paths and bodies touch."""
    grid = surveyed(Problem.of(assumed, _ANY_MEASURE))
    paths = np.isin(grid.status, (Status.FEASIBLE, Status.COLLISION))
    colliding = int((grid.status == Status.COLLISION).sum())
    return Result(
        obtained={"colliding": colliding, "with_paths": int(paths.sum())},
        caption=caption("claim_meets_collision", positions=len(grid.points)),
    )


@checks(
    "pan.claim_meets_singularity",
    samples=_DRAWS,
    rules=[
        Bounded(
            "ratio",
            "smallest manipulability met on any seam, over the threshold of a singularity",
            high=1.0,
        )
    ],
)
def meets_singularity(assumed: Assumed) -> Result:
    """The position whose seam passes nearest to a singularity, the threshold left aside."""
    task = Problem.of(assumed, _ANY_MEASURE)
    placement = Placement(replace(task.job.cell(), threshold=0.0), task.measure.reading())
    rule, known = "nearest_singularity", surveyed(task)
    found = extreme_position(placement, task.box, rule, spacing=SPACING, starts=STARTS, known=known)
    if not found.fitness:
        return nothing_feasible("ratio", "position")
    smallest = 1.0 / found.fitness
    return Result(
        obtained={
            "ratio": float(smallest / task.job.singularity_threshold),
            "smallest": float(smallest),
            "position": found.position.tolist(),
        },
        caption=caption("claim_meets_singularity", threshold=task.job.singularity_threshold),
    )
