"""Page `pan/weld`: whether the job of `pan` can be carried out, how fast, and at what effort."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd

from ....ledger import REGISTRY, Assumed, Bounded, Result
from ....ledger.captions import captions
from ....view.seam_curves import rates_figure
from ....welding import ROBOTS, saddle_seam
from ....welding.between import certified_separation, interpolation_offset
from ....welding.execution import EFFORTS, arc_speed, joint_rates, seam_rate, speed_limits
from ....welding.grid_search import grid_points
from ....welding.placement import blocks
from ..reading import (
    SPACING,
    Problem,
    job_scene_at,
    nothing_feasible,
    optimum,
    poor_position,
    solved,
)

checks = partial(REGISTRY.checks, page="pan/weld")
caption = captions(__file__)
_DENSE = 20_000  # points of the seam that the torch is compared with


@checks(
    "pan.claim_joint_sequence",
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
    fastest, q = arc_speed(cell, jobs), jobs.q[0]
    columns = {
        f"{name} q{j + 1} [deg]": np.degrees(q[k, :, j])
        for k, name in enumerate(ROBOTS)
        for j in range(6)
    }
    return Result(
        obtained={
            "separation": bound.lower,
            "off_seam": offset.seam,
            "arc_speed": fastest.speed,
            "largest_step_deg": float(np.degrees(offset.step)),
            "grips_apart": offset.grips,
            "position": best.position.tolist(),
        },
        table=pd.DataFrame({"arc [m]": _arc(seam_rate(cell)), **columns}),
        caption=caption("claim_joint_sequence", points=cell.count, fastest=fastest),
        alt="Largest turn of a joint of each robot per millimetre of seam, against its limit.",
        figure=lambda: rates_figure(
            joint_rates(cell, jobs) / speed_limits(cell)[:, np.newaxis], fastest.speed
        ),
        scene=lambda: job_scene_at("The weld at the optimum.", cell, jobs, best.position),
    )


def _arc(rate: np.ndarray) -> np.ndarray:
    """Length of the seam from its first point to each (N,) [m], by the trapezoidal rule."""
    steps = 0.5 * (rate + np.roll(rate, -1)) * 2 * np.pi / len(rate)
    return np.concatenate([[0.0], np.cumsum(steps[:-1])])


@checks(
    "pan.claim_sudden_turns",
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
    rules=[
        Bounded("better", "feasible positions of a grid with less effort than the optimum", high=0)
    ],
)
def least_effort(assumed: Assumed) -> Result:
    """A proxy for effort at the optimum, against that at all feasible positions."""
    task = Problem.of(assumed)
    best, effort = optimum(task), EFFORTS[assumed["effort_measure"]]
    if not best.fitness:
        return nothing_feasible("better", "share")
    cell, placement = task.job.cell(), task.placement()
    values, fitness = [], []
    for block in blocks(grid_points(task.box, SPACING)):
        jobs = placement.jobs(block)
        if jobs.feasible.any():
            part = jobs.select(jobs.feasible)
            values.append(effort(cell, part))
            fitness.append(placement.score(part))
    every, scores = np.concatenate(values), np.concatenate(fitness)
    own = float(effort(cell, solved(task.job, tuple(best.position)))[0])
    return Result(
        obtained={
            "better": int((every < own).sum()),
            "share": float((every < own).mean()),
            "least": float(every.min() / own),
            "fitness_there": float(scores[every.argmin()] / best.fitness),
        },
        caption=caption(
            "claim_energy",
            effort=assumed["effort_measure"].replace("_", " "),
            positions=len(every),
            correlation=float(np.corrcoef(scores, every)[0, 1]) if len(every) > 1 else None,
        ),
    )
