"""Page `pan/weld`: whether the job of `pan` can be carried out, how fast, and at what effort."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from ....ledger import REGISTRY, Assumed, Bounded, Result
from ....ledger.captions import captions
from ....view.seam_curves import rates_figure
from ....welding import ROBOTS, Cell, Jobs, saddle_seam
from ....welding.between import certified_separation, interpolation_offset
from ....welding.execution import EFFORTS, arc_speed, joint_rates, seam_rate, speed_limits
from ....welding.placement import blocks
from ..reading import (
    Problem,
    job_scene_at,
    nothing_feasible,
    optimum,
    poor_position,
    solved,
    surveyed,
)

checks = partial(REGISTRY.checks, page="pan/weld")
caption = captions(__file__)
_DRAWS = 16  # of the assumptions; each needs a survey of the region
_DENSE = 20_000  # points of the seam that the torch is compared with


@checks(
    "pan.claim_joint_sequence",
    samples=_DRAWS,
    rules=[
        Bounded(
            "separation",
            "separation certified between the seam points, joints interpolated [m]",
            low=0.0,
        ),
        Bounded("off_seam", "largest distance of the torch from the seam [m]", high="off_seam"),
        Bounded(
            "arc_speed",
            "largest speed along the seam within the speed limits [m/s]",
            low="welding_speed",
        ),
    ],
)
def joint_sequence(assumed: Assumed) -> Result:
    """The joint sequence at the optimum as a controller would run it."""
    task = Problem.of(assumed)
    best = optimum(task)
    if not best.fitness:
        return nothing_feasible("separation", "off_seam", "arc_speed")
    cell, jobs = task.job.cell(), solved(task.job, tuple(best.position))
    seam = saddle_seam(task.job.radius_main, task.job.radius_branch, _DENSE).points
    bound, offset = certified_separation(cell, jobs), interpolation_offset(cell, jobs, seam)
    fastest = arc_speed(cell, jobs)
    return Result(
        obtained={
            "separation": bound.lower,
            "off_seam": offset.seam,
            "arc_speed": fastest.speed,
            "largest_step_deg": float(np.degrees(offset.step)),
            "grips_apart": offset.grips,
            "position": best.position.tolist(),
        },
        table=job_file(cell, jobs, _limit("welding_speed")),
        caption=caption("claim_joint_sequence", points=cell.count, fastest=fastest),
        alt="Largest turn of a joint of each robot per millimetre of seam, against its limit.",
        figure=lambda: rates_figure(
            joint_rates(cell, jobs) / speed_limits(cell)[:, np.newaxis], fastest.speed
        ),
        scene=lambda: job_scene_at("The weld at the optimum.", cell, jobs, best.position),
    )


def job_file(cell: Cell, jobs: Jobs, pace: float) -> pd.DataFrame:
    """The weld at one pace [m/s]: time, way along the seam, joints of three arms, first point last.

    The seam is closed, so that the last row is at its first point again, one turn later.
    """
    path = jobs.q[0]
    turned = 2 * np.pi * np.round((path[:, -1:] - path[:, :1]) / (2 * np.pi))
    q, rate = np.degrees(np.concatenate([path, path[:, :1] + turned], axis=1)), seam_rate(cell)
    steps = 0.5 * (rate + np.roll(rate, -1)) * 2 * np.pi / cell.count  # trapezoidal rule
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    columns = {
        f"{name} q{j + 1} [deg]": q[k, :, j] for k, name in enumerate(ROBOTS) for j in range(6)
    }
    return pd.DataFrame({"time [s]": arc / pace, "seam [m]": arc, **columns})


def _limit(name: str) -> float:
    limits = REGISTRY.look("pan.claim_joint_sequence", "thresholds").thresholds
    return float(limits[name].value)


@checks(
    "pan.claim_sudden_turns",
    samples=_DRAWS,
    rules=[
        Bounded(
            "ratio",
            "largest turn of a joint per length of seam at position (b), over that at the optimum",
            low="sudden",
        )
    ],
)
def sudden_turns(assumed: Assumed) -> Result:
    """Speeds that one pace of the torch asks of the joints, at position (b) and at the optimum."""
    task = Problem.of(assumed)
    best, poor = optimum(task), poor_position(task, assumed["poor_position_b"])
    if not best.fitness or not poor.fitness:
        return nothing_feasible("ratio", "position")
    cell, places = task.job.cell(), (poor.position, best.position)
    here, there = (arc_speed(cell, solved(task.job, tuple(place))) for place in places)
    return Result(
        obtained={
            "ratio": there.speed / here.speed,
            "arc_speed": here.speed,
            "position": poor.position.tolist(),
        },
        caption=caption("claim_sudden_turns", here=here, there=there),
    )


@checks(
    "pan.claim_energy",
    samples=_DRAWS,
    rules=[
        Bounded("better", "feasible positions of a grid with less effort than the optimum", high=0),
        Bounded("positions", "feasible positions of the grid", low="enough"),
    ],
)
def least_effort(assumed: Assumed) -> Result:
    """A proxy for effort at the optimum, against that at all feasible positions."""
    task = Problem.of(assumed)
    best, effort = optimum(task), EFFORTS[assumed["effort_measure"]]
    if not best.fitness:
        return nothing_feasible("better", "positions", "share")
    cell, placement, grid = task.job.cell(), task.placement(), surveyed(task)
    feasible = grid.fitness > 0
    parts = [effort(cell, placement.jobs(some)) for some in blocks(grid.points[feasible])]
    every, scores = np.concatenate(parts), grid.fitness[feasible]
    vary = min(np.ptp(scores), np.ptp(every)) > 0.0
    own = float(effort(cell, solved(task.job, tuple(best.position)))[0])
    return Result(
        obtained={
            "better": int((every < own).sum()),
            "positions": len(every),
            "share": float((every < own).mean()),
            "least": float(every.min() / own),
            "fitness_there": float(scores[every.argmin()] / best.fitness),
        },
        caption=caption(
            "claim_energy",
            effort=assumed["effort_measure"].replace("_", " "),
            correlation=float(np.corrcoef(scores, every)[0, 1]) if vary else None,
        ),
    )
