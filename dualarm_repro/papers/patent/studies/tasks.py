"""Random tasks: which collide without avoidance, and how the QP and the network fare on them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....control.effort import effort
from ....control.frozen import arm_pair
from ....control.motion import Motion
from ....control.neural.fixed_step import simulate_network
from ....control.neural.guarded import simulate_guarded
from ....control.neural.network_settings import NetworkSettings
from ....control.random_tasks import (
    admissible,
    draw_task,
    naive_motion,
    stands_clear,
)
from ....control.settings import ControllerSettings, RowForm
from ....control.simulate import simulate
from ....control.system import ArmSystem
from ....ledger import REGISTRY, Study
from ....ledger.assumptions import Chosen
from ....ledger.comparison import Comparison
from ..document import COARSE_STEP, CONTROL_STEP, RADII, SEED, redundant_arm

#: A slack that gives up more of the task and chatters less.
CALM = {"slack_weight": 1e2, "smoothing": 10.0}
#: What every draw is made with; the paths take as long as those of the frozen scenarios.
SETTINGS = Chosen(
    "patent",
    ("robot", "base_distance"),
    radii=list(RADII),
    step=COARSE_STEP,
    network_step=CONTROL_STEP,
    outer=ControllerSettings().outer,
    inner=ControllerSettings().inner,
    calm=CALM,
)

#: Columns and the properties of a motion that they hold.
MEASURES = (
    ("finished", "finished"),
    ("completed", "completed"),
    ("distance", "smallest_distance"),
    ("error", "largest_error"),
    ("acceleration", "peak_acceleration"),
    ("roughness", "rms_acceleration"),
    ("beyond_angle", "angle_excess"),
    ("beyond_speed", "speed_excess"),
)
_CHATTER = "motion with slack chatters between its rows, which amplifies round-off"
#: Columns of the study that another processor may give otherwise.
DELICATE = tuple(
    Comparison(f"{name}_{column}", _CHATTER, **bound)
    for name in ("slack", "calm", "guarded")
    for column, bound in (
        ("distance", {"absolute": 2e-3}),
        ("error", {"relative": 0.1}),
        ("acceleration", {"relative": 0.5}),
        ("roughness", {"relative": 0.5}),
    )
)


def cells() -> list[dict[str, int]]:
    """One cell a draw."""
    return [{"draw": k} for k in range(REGISTRY.assumption("patent.task_selection"))]


def compute(cell: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Screen one task; if naive motion collides, run it with every reading and every solver.

    A task is set if its start touches neither itself nor the floor; it counts if its start is also
    outside the outer range and the pseudo-inverse follows its path.
    """
    system = arm_pair(redundant_arm(SETTINGS["robot"]), SETTINGS["base_distance"])
    settings, task = ControllerSettings(), draw_task(system, rng, RADII)
    if not stands_clear(system, task):
        return {"set": False, "counts": False}
    naive = naive_motion(system, task, settings)
    if not admissible(naive, settings):
        return {"set": True, "counts": False}
    found: dict[str, Any] = {
        "set": True,
        "counts": True,
        "naive_distance": naive.smallest_distance,
        "naive_beyond_angle": naive.angle_excess,
        "collides": naive.smallest_distance < 0,
        **_paid("naive", system, naive),
    }
    if not found["collides"]:
        return found
    parts = (system, task.circles(system), task.q0)
    for form in RowForm:
        exact = simulate(*parts, ControllerSettings(form=form), dt=COARSE_STEP)
        found |= _judged(form, exact)
        if form is RowForm.PAIR_NORMAL:
            found |= _paid(form, system, exact)
    limited = simulate(*parts, ControllerSettings(avoid=False), dt=COARSE_STEP)
    alone = simulate(*parts, ControllerSettings(limits=False), dt=COARSE_STEP)
    slack = simulate(*parts, settings, dt=COARSE_STEP, slack=True)
    calm = simulate(*parts, settings, dt=COARSE_STEP, slack=True, **CALM)  # type: ignore[arg-type]
    network = simulate_network(*parts, settings, NetworkSettings(), dt=CONTROL_STEP)
    guarded, shares = simulate_guarded(*parts, settings, NetworkSettings(), dt=CONTROL_STEP)
    named = {"limits": limited, "alone": alone, "slack": slack, "calm": calm}
    named |= {"network": network, "guarded": guarded}
    for name, motion in named.items():
        found |= _judged(name, motion)
    return {**found, "guarded_slowed": shares.slowed, "guarded_time": float(guarded.time[-1])}


def _judged(name: str, motion: Motion) -> dict[str, Any]:
    """The measures of a motion, as columns."""
    return {f"{name}_{key}": getattr(motion, measure) for key, measure in MEASURES}


def _paid(name: str, system: ArmSystem, motion: Motion) -> dict[str, float]:
    """Mean speed, index and effort of a motion, as columns."""
    paid = effort(system, motion)._asdict()
    return {
        f"{name}_speed": motion.mean_speed,
        f"{name}_energy": motion.energy,
        **{f"{name}_{key}": value for key, value in paid.items()},
    }


TASKS = REGISTRY.keeps(
    Study(
        name="patent_tasks",
        title="Random tasks of two Pandas: collisions without avoidance, completion with five "
        "readings, with slack, by the network and by the guarded network",
        cells=cells,
        compute=compute,
        compared=DELICATE,
        seed=SEED,
        settings=SETTINGS,
    )
)
