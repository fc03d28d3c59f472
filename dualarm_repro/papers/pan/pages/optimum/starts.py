"""What `pan` says of badly chosen starts: no complete motion, collisions, singularities."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from .....ledger import REGISTRY, Assumed, Bounded, Result
from .....ledger.captions import captions
from .....scene.scene import FLOOR
from .....view.landscape import statuses_figure
from .....welding import Status
from .....welding.landscape import reaches_point
from .....welding.placement import blocks, statuses
from ...reading import Job, Measure, Problem, surveyed

checks = partial(REGISTRY.checks, page="pan/optimum")
caption = captions(__file__)
_NO_PATH = (Status.OUT_OF_REACH, Status.JOINT_LIMITS)
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
    alone = _alone(task.job, grid.points)
    no_path = np.isin(alone, _NO_PATH).any(axis=1)
    far = (alone == Status.OUT_OF_REACH).any(axis=1)
    lost = np.where(far, Status.OUT_OF_REACH, Status.JOINT_LIMITS)[begun & no_path]
    found = Status(int(np.bincount(lost).argmax())) if len(lost) else None
    return Result(
        obtained={
            "lost": len(lost),
            "begun": int(begun.sum()),
            "share": float(no_path[begun].mean()) if begun.any() else None,  # type: ignore[index]
            "mostly": found.name.lower().replace("_", " ") if found is not None else None,
        },
        caption=caption("claim_bad_start", positions=len(grid.points)),
        alt="Two maps of the region that show which constraint excludes a position.",
        figure=lambda: statuses_figure(task.job.placement(), task.box),
    )


@checks(
    "pan.claim_meets_collision",
    rules=[
        Bounded(
            "colliding",
            "positions with full paths on which a robot touches another or the workpiece",
            low=1,
        ),
    ],
)
def meets_collision(assumed: Assumed) -> Result:
    """Positions of the grid at which all robots have paths and bodies touch, the floor aside."""
    task = Problem.of(assumed, _ANY_MEASURE)
    grid = surveyed(task)
    paths = np.isin(grid.status, (Status.FEASIBLE, Status.COLLISION))
    touching = _contacts(task.job, grid.points[grid.status == Status.COLLISION])
    between = touching[[pair for pair in touching if FLOOR not in pair]]
    pairs = between.sum().sort_values(ascending=False)
    colliding = between.any(axis=1)
    return Result(
        obtained={
            "colliding": int(colliding.sum()),
            "floor_alone": int((~colliding).sum()),
            "with_paths": int(paths.sum()),
            "pairs": {" - ".join(pair): int(count) for pair, count in pairs.items() if count},
        },
        caption=caption("claim_meets_collision"),
    )


def _alone(job: Job, points: np.ndarray) -> np.ndarray:
    """Status of every robot at positions (P, 3), whichever fails first -> (P, R)."""
    return np.concatenate([statuses(job.cell(), block) for block in blocks(points)])


def _contacts(job: Job, points: np.ndarray) -> pd.DataFrame:
    """Which owners (columns) touch somewhere along the seam at positions (P, 3) (rows)."""
    placement = job.placement()
    separation = placement.separation
    found = [np.empty((0, len(separation.owners)), dtype=bool)]
    for jobs in map(placement.jobs, blocks(points)):
        found.append(separation.per_pair(jobs.q, jobs.centres) <= 0)
    table = pd.DataFrame(np.concatenate(found).T, index=separation.owners)
    return table.groupby(level=0).any().T


@checks(
    "pan.claim_meets_singularity",
    rules=[
        Bounded(
            "singular",
            "positions with complete paths on which a robot passes a singular posture",
            low=1,
        )
    ],
)
def meets_singularity(assumed: Assumed) -> Result:
    """Positions of the grid at which all robots have paths and one of these is singular."""
    task = Problem.of(assumed, _ANY_MEASURE)
    grid = surveyed(task)
    alone = _alone(task.job, grid.points)
    paths = ~np.isin(alone, _NO_PATH).any(axis=1)
    singular = paths & (alone == Status.SINGULAR).any(axis=1)
    return Result(
        obtained={"singular": int(singular.sum()), "with_paths": int(paths.sum())},
        caption=caption("claim_meets_singularity", threshold=task.job.singularity_threshold),
    )
