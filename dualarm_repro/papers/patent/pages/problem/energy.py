"""What the text says of energy: tied to the mean joint speed, and redundant motion removed."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
from scipy.stats import spearmanr

from .....control.controller import VelocityController
from .....control.redundancy import inertia_weighted
from .....control.settings import ControllerSettings
from .....control.solvers import solve
from .....ledger import REGISTRY, Assumed, Generally, Residual, Result
from .....ledger.captions import captions
from .....ledger.witnesses import is_open, one_for_each_side
from .....view.effort_figure import effort_figure
from ...document import COARSE_STEP, frozen, run
from ...studies.tasks import TASKS

checks = partial(REGISTRY.checks, page="patent/problem")
caption = captions(__file__)
_PRESSES = 1e-9  # multiplier from which on an inequality presses


@checks(
    "patent.claim_energy",
    rules=[
        Generally(
            "concordant",
            "pairs of tasks of which the one with the higher mean joint speed takes more energy",
            at_least="nearly_all",
            margin="margin",
        )
    ],
)
def energy_follows_speed(assumed: Assumed) -> Result:
    """Mean joint speed and energy by inverse dynamics over the random tasks, in disjoint pairs.

    A task of the first half is paired with one of the second.
    """
    table = TASKS.load()
    table = table[table["counts"].astype(bool)]
    measure = assumed["energy_measure"]
    speed, energy = (table[f"naive_{key}"].to_numpy(float) for key in ("speed", measure))
    half = len(table) // 2
    faster, dearer = (values[:half] > values[half : 2 * half] for values in (speed, energy))
    agree = faster == dearer
    both = table[table["pair_normal_completed"].eq(True)]
    ratio = {
        key: float((both[f"pair_normal_{key}"] / both[f"naive_{key}"]).astype(float).median())
        for key in ("energy", measure)
    }
    found = {
        "concordant": {"count": int(agree.sum()), "of": len(agree)},
        "correlation": float(spearmanr(speed, energy).statistic),
        "index_ratio": ratio["energy"],
        "energy_ratio": ratio[measure],
    }
    pairs = (
        (
            f"tasks {k} and {half + k}",
            bool(agree[k]),
            {"speeds": [speed[k], speed[half + k]]},
        )
        for k in range(len(agree))
    )
    return Result(
        obtained=found,
        table=pd.DataFrame({"mean speed [rad/s]": speed, measure: energy}),
        witnesses=one_for_each_side(pairs) if is_open("patent.claim_energy", found) else [],
        caption=caption("claim_energy", measure=measure, avoided=len(both)),
        alt="Cloud of points, energy over mean joint speed, rising with a wide spread.",
        figure=lambda: effort_figure(speed, energy, measure),
    )


@checks(
    "patent.claim_redundant_motion",
    samples=8,
    rules=[
        Residual(
            "left_over",
            "joint velocity that moves no tip where no inequality presses, at most [rad/s]",
            high=1e-9,
        )
    ],
)
def redundant_motion(assumed: Assumed) -> Result:
    """Null-space part of the joint velocity along the frozen crossing."""
    scenario, settings = frozen("crossing"), ControllerSettings()
    motion = run(scenario, settings, COARSE_STEP)
    controller = VelocityController(scenario.system, settings, home=scenario.q0)
    free: list[float] = []
    pressed: list[float] = []
    for k in range(0, len(motion.x), 20):
        q = motion.q[k]
        p = controller.problem(q, *scenario.circles.at(motion.time[k]))
        exact = solve(p)
        presses = max(exact.z.max(initial=0.0), np.abs(exact.w).max()) > _PRESSES
        x = exact.x
        if assumed["energy_weight"] == "inertia" and not presses:
            x = inertia_weighted(scenario.system, q, p)
        idle = x - np.linalg.pinv(p.A) @ p.A @ x
        (pressed if presses else free).append(float(np.linalg.norm(idle)))
    drift = float(np.abs(motion.q[-1] - motion.q[0]).max())
    return Result(
        obtained={
            "left_over": max(free),
            "with_avoidance": max(pressed, default=0.0),
            "free": len(free),
            "pressed": len(pressed),
            "drift": drift,
        },
        caption=caption("claim_redundant_motion"),
    )
