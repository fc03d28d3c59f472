"""The recorded search for the frozen scenarios: draws in a row, judged at the control rate."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import yaml

from ...control.motion import Motion
from ...control.settings import ControllerSettings
from ...control.simulate import pseudo_inverse, simulate
from ...control.system import ArmSystem
from .constants import SEED
from .tasks import REACHED, Task, arm_pair, draw_task

BASE_DISTANCE = 0.6
RADII = (0.10, 0.20)
#: What a frozen scenario has to meet at 1 kHz.
DEEP, KEPT, TRACKED = -0.05, 5e-4, 5e-5

Judge = Callable[[ArmSystem, Task, ControllerSettings], float | None]


def crossing(system: ArmSystem, task: Task, settings: ControllerSettings) -> float | None:
    """Score of a task on which naive motion collides deeply and avoidance completes."""
    circles = task.circles(system)
    naive = simulate(system, circles, task.q0, pseudo_inverse(settings), dt=0.01)
    if not _free_start(naive, settings) or naive.smallest_distance > DEEP:
        return None
    motion = simulate(system, circles, task.q0, settings)
    return _peak(motion) if _clean(motion, settings) else None


def limits(system: ArmSystem, task: Task, settings: ControllerSettings) -> float | None:
    """Score of a task on which naive motion leaves the joint ranges and the arms come close."""
    circles = task.circles(system)
    naive = simulate(system, circles, task.q0, pseudo_inverse(settings), dt=0.01)
    arrays = system.arrays
    excess = max(float((naive.q - arrays.upper).max()), float((arrays.lower - naive.q).max()))
    if not _free_start(naive, settings) or excess < 0.1:
        return None
    motion = simulate(system, circles, task.q0, settings)
    return _peak(motion) if _clean(motion, settings) and motion.rows.max() > 0 else None


def too_close(system: ArmSystem, task: Task, settings: ControllerSettings) -> float | None:
    """Score of a task that starts inside the inner range, without contact, and is completed."""
    circles = task.circles(system)
    naive = simulate(system, circles, task.q0, pseudo_inverse(settings), dt=0.01)
    inside = 0.0 < naive.distance[0] < 0.5 * settings.inner
    if not inside or naive.largest_error > REACHED:
        return None
    motion = simulate(system, circles, task.q0, settings)
    return _peak(motion) if motion.completed else None


#: Scenario to robot, judge, number of draws and title.
#: What each search looks for, as the scenario file says it.
WANTED: dict[Judge, str] = {
    crossing: "a task on which naive motion collides deeply and avoidance completes.",
    limits: "a task on which naive motion leaves the joint ranges and the arms come close.",
    too_close: "a task that starts inside the inner range, without contact, and is completed.",
}
SEARCHES: dict[str, tuple[str, Judge, int, str]] = {
    "crossing": ("panda", crossing, 3000, "Two Pandas whose arms cross without avoidance"),
    "crossing_xarm7": ("xarm7", crossing, 3000, "Two xArm 7 whose arms cross without avoidance"),
    "limits": ("panda", limits, 1500, "Two Pandas driven to joint limits beside each other"),
    "too_close": ("panda", too_close, 3000, "Two Pandas that start inside the inner range"),
}


def search(name: str) -> dict:
    """The admissible draw of smallest peak acceleration, as the content of its scenario file."""
    robot, judge, draws, title = SEARCHES[name]
    system, settings = arm_pair(robot, BASE_DISTANCE), ControllerSettings()
    scored = []
    for draw in range(draws):
        task = draw_task(system, np.random.default_rng([SEED, draw]), RADII)
        score = judge(system, task, settings)
        if score is not None:
            scored.append((score, draw))
    _, draw = min(scored)
    task = draw_task(system, np.random.default_rng([SEED, draw]), RADII)
    halves = np.split(task.q0, system.arrays.start[1:-1])
    sides = {
        side: {
            "q": [round(float(v), 6) for v in q],
            "normal": [round(float(v), 6) for v in task.normals[k]],
            "angle": round(float(task.angles[k]), 6),
        }
        for k, (side, q) in enumerate(zip(("left", "right"), halves, strict=True))
    }
    return {
        "kind": "velocity-control",
        "title": title,
        "robot": robot,
        "base_distance": BASE_DISTANCE,
        "radius": round(task.radius, 6),
        "duration": 10.0,
        **sides,
        "found": {
            "seed": [SEED, draw],
            "criteria": f"least peak acceleration of {len(scored)} admissible among {draws} draws; "
            f"{WANTED[judge]}",
        },
    }


def freeze(folder: Path) -> None:
    """Run every search and write the scenario files, which takes some minutes."""
    for name in SEARCHES:
        text = yaml.safe_dump(search(name), sort_keys=False, width=100, default_flow_style=None)
        (folder / f"patent_{name}.yaml").write_text(text, encoding="utf-8")


def _free_start(naive: Motion, settings: ControllerSettings) -> bool:
    return naive.largest_error < REACHED and naive.distance[0] > settings.outer


def _clean(motion: Motion, settings: ControllerSettings) -> bool:
    return (
        motion.completed
        and motion.smallest_distance >= settings.inner - KEPT
        and motion.largest_error <= TRACKED
    )


def _peak(motion: Motion) -> float:
    return motion.peak_acceleration
